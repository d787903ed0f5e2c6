# SPDX-License-Identifier: Apache-2.0
"""What ``--help`` prints for a node."""

from srnn_config import ParameterSpec
from srnn_node.access import MEANING, PARAMETER
from srnn_node.lifecycle import STARTING, WorkspaceNode
from srnn_node.parameters import leaves


def usage(node_class: type[WorkspaceNode]) -> str:
    """Return the purpose of a node and its parameters with their bounds and units."""
    lines = [
        (node_class.__doc__ or node_class.__name__).strip().splitlines()[0],
        '',
        'usage: --ros-args [-p NAME:=VALUE]... [--params-file FILE] [-r FROM:=TO]...',
        '',
        'parameters:',
        *(f'  {name}: {text}' for name, text in STARTING.items()),
        f'  {PARAMETER}: {MEANING}',
    ]
    for leaf in leaves(node_class.PARAMETERS):
        lines.append(f'  {leaf.name}: {leaf.spec.doc}{_limits(leaf.spec)}')
    return '\n'.join(lines)


def _limits(spec: ParameterSpec) -> str:
    """Return bounds and unit in parentheses; nothing where there is nothing to say."""
    bounds = '' if spec.bounds() == 'finite' else spec.bounds()
    unit = f'[{spec.unit}]' if spec.unit else ''
    words = ' '.join(filter(None, (bounds, unit)))
    return f' ({words})' if words else ''
