# SPDX-License-Identifier: Apache-2.0
"""The arguments of the launch file, made from the options of `srnn up`."""

import argparse
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
import re
from typing import NoReturn

from srnn_bringup.config_lookup import arm_names, config_directory, network_names, scene_names
from srnn_bringup.errors import ChoiceError
from srnn_bringup.graph_options import add_up_options
from srnn_config.nearest import did_you_mean

_OF_LAUNCH = ('launch-prefix', 'launch-prefix-filter')
"""Arguments that `ros2 launch` itself adds."""

_DEFAULT = re.compile(r' \(default: .*\)$')


@dataclass(frozen=True)
class LaunchArgument:
    """One argument; all values are texts, and the empty one leaves the choice to others.

    Attributes:
        name: what the user calls it.
        default: value when the user gives none.
        choices: the only valid values, None where there are others.
        meaning: one sentence for the user.

    """

    name: str
    default: str
    choices: tuple[str, ...] | None
    meaning: str


class _Parser(argparse.ArgumentParser):
    """Raises what it would print."""

    def error(self, message: str) -> NoReturn:
        raise ChoiceError(re.sub(r'argument --([\w-]+)', lambda m: _name(m[1]), message))


def launch_arguments() -> list[LaunchArgument]:
    """Return the arguments in the order of the options."""
    directory = config_directory()
    names = {
        'arm_description': arm_names(directory),
        'scene': scene_names(directory),
        'network': network_names(directory),
    }
    return [_argument(action, names.get(action.dest, [])) for action in _parser()._actions]


def read_arguments(given: Mapping[str, str]) -> argparse.Namespace:
    """Return the options of `srnn up` that have these values.

    Args:
        given: value of every argument by name.

    Raises:
        ChoiceError: a value is not valid; the message names the argument and the valid ones.

    """
    parser = _parser()
    line = []
    for action in parser._actions:
        value, option = given[action.dest], action.option_strings[0]
        if action.nargs == 0:
            line += [option] if value == 'true' else []
        elif value:
            line.append(f'{option}={value}')
    return parser.parse_args(line)


def refuse_unknown(names: Iterable[str]) -> None:
    """Refuse what nobody would miss: `ros2 launch` ignores arguments that it does not know.

    Raises:
        ChoiceError: one of the names is of no argument; the message lists those there are.

    """
    known = [action.dest for action in _parser()._actions]
    for name in names:
        if name not in (*known, *_OF_LAUNCH):
            hint = did_you_mean(name, known)
            raise ChoiceError(f"unknown argument '{name}'{hint}; arguments: {', '.join(known)}")


def _parser() -> _Parser:
    parser = _Parser(add_help=False, allow_abbrev=False)
    add_up_options(parser)
    return parser


def _argument(action: argparse.Action, names: Sequence[str]) -> LaunchArgument:
    choices: tuple[str, ...] | None = None
    default = '' if action.default is None else str(action.default)
    if action.nargs == 0:
        default, choices = 'false', ('false', 'true')
    elif action.choices is not None:
        choices = tuple(map(str, action.choices))
        if action.default is None:
            choices = ('', *choices)
    elif action.default == ():
        default = ''
    # Where there is a default, launch shows it.
    meaning = _DEFAULT.sub('', str(action.help)) if default else str(action.help)
    known = f'; names: {", ".join(names)}' if names else ''
    return LaunchArgument(action.dest, default, choices, meaning % vars(action) + known)


def _name(option: str) -> str:
    return option.replace('-', '_')
