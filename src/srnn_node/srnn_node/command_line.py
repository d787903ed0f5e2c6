# SPDX-License-Identifier: Apache-2.0
"""The command line of a node: ROS arguments, ``--help``, and nothing else."""

from collections.abc import Mapping, Sequence
import sys

from rclpy.utilities import remove_ros_args

from srnn_config import Parameters
from srnn_node.parameters import Leaf, leaves

WRONG_USE = 2
"""Exit code after a wrong command line."""


def read_command_line(command_line: Sequence[str], name: str, usage: str) -> int | None:
    """Answer ``--help``, refuse what no node knows.

    Args:
        command_line: program and its arguments.
        name: what to call the node in complaints.
        usage: answer to ``--help``.

    Returns:
        Exit code; None where the node is to be run.

    """
    try:
        extra = remove_ros_args(list(command_line))[1:]
        wrong = f'unknown argument {extra[0]!r}' if extra else ''
    except RuntimeError as error:
        extra, wrong = [], str(error)
    if extra == ['--help']:
        print(usage)
        return 0
    if wrong:
        print(f'{name}: {wrong}; try --help', file=sys.stderr)
        return WRONG_USE
    return None


def usage(
    documentation: str, parameters: type[Parameters], common: Mapping[str, str] | None = None
) -> str:
    """Return the purpose of a node and its parameters with their bounds and units.

    Args:
        documentation: what the node is for; its first line counts.
        parameters: its parameter set.
        common: parameters that it has besides, with their meaning.

    """
    lines = [
        documentation.strip().splitlines()[0],
        '',
        'usage: --ros-args [-p NAME:=VALUE]... [--params-file FILE] [-r FROM:=TO]...',
        '',
        'parameters:',
        *(f'  {name}: {text}' for name, text in (common or {}).items()),
    ]
    for leaf in leaves(parameters):
        lines.append(f'  {leaf.name}: {leaf.spec.doc}{_limits(leaf)}')
    return '\n'.join(lines)


def _limits(leaf: Leaf) -> str:
    """Return what there is to say of a value in parentheses: required, bounds, unit."""
    spec = leaf.spec
    need = 'required' if leaf.required else ''
    bounds = '' if spec.bounds() == 'finite' else spec.bounds()
    unit = f'[{spec.unit}]' if spec.unit else ''
    words = ' '.join(filter(None, (need, bounds, unit)))
    return f' ({words})' if words else ''
