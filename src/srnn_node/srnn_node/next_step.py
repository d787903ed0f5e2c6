# SPDX-License-Identifier: Apache-2.0
"""What a node tells the person that it waits for."""

from srnn_node.lifecycle import WorkspaceNode
from srnn_node.parameters import leaves

_TRANSITIONS = {'unconfigured': 'configure', 'inactive': 'activate'}


def next_step(node: WorkspaceNode) -> str:
    """Return what has to be done before a node works, empty if nothing has.

    What it was not given at its start it cannot be given later: its parameters are read once.
    """
    state = node.state
    if state not in _TRANSITIONS:
        return ''
    lacking = [
        leaf.name
        for leaf in leaves(node.PARAMETERS)
        if leaf.required and leaf.name not in node._parameter_overrides
    ]
    if lacking:
        return (
            f'{state}: cannot be configured without {", ".join(lacking)}; '
            f'start it again with --ros-args -p {lacking[0]}:=VALUE or --params-file FILE'
        )
    command = f'ros2 lifecycle set {node.get_fully_qualified_name()} {_TRANSITIONS[state]}'
    return f'{state}: waiting for {command}'
