# SPDX-License-Identifier: Apache-2.0
"""Command line values that are checked before anything starts."""

import argparse
from collections.abc import Callable
import math
from pathlib import Path
import re
from typing import TypeVar

from srnn_bringup.choices import ARM_DESCRIPTION, NETWORK, ROOT, SEED_MAX, STANDARD_SCENE
from srnn_bringup.errors import ChoiceError
from srnn_bringup.peers import find_peer

PICTURE_FORMATS = ('.png', '.pdf', '.svg')

V = TypeVar('V')

VIEW_PORT = 8080

_NAMESPACE = re.compile(r'(/[A-Za-z_](_?[A-Za-z0-9])*_?)+')
"""Of two underscores in a row ROS makes no name."""

_REMAPPING = re.compile(r'([\w~/]+):=([\w~/]+)')


def add_scene(parser: argparse.ArgumentParser) -> None:
    """Add the choice of a scene."""
    parser.add_argument(
        '--scene', default=STANDARD_SCENE, metavar='SCENE',
        help='name of a scene in config/scenes, or path of a scene file (default: %(default)s)',
    )


def add_arm_description(parser: argparse.ArgumentParser) -> None:
    """Add the choice of what the arm is."""
    parser.add_argument(
        '--arm-description', default=ARM_DESCRIPTION, metavar='DESCRIPTION',
        help='name of an arm in config/arms, or path of its file (default: %(default)s)',
    )


def add_network(parser: argparse.ArgumentParser, default: str = NETWORK) -> None:
    """Add the choice of a network."""
    parser.add_argument(
        '--network', default=default, metavar='NETWORK',
        help='name of a network in config, or path of its file (default: %(default)s)',
    )


def add_learning(parser: argparse.ArgumentParser) -> None:
    """Add what is learned with, and from which weights."""
    from srnn_planner.core.dissonance import SIGNALS

    parser.add_argument(
        '--signal', choices=tuple(SIGNALS), help='learning signal (default: as NETWORK says)'
    )
    parser.add_argument(
        '--alpha', type=rate, metavar='A', help='rate of the signals constant and untriggered'
    )
    parser.add_argument(
        '--weights', type=existing_file, metavar='FILE', help='weights to start from'
    )


def add_seed(parser: argparse.ArgumentParser, text: str) -> None:
    """Add the seed."""
    parser.add_argument(
        '--seed', type=whole(0, SEED_MAX), default=0, metavar='S',
        help=f'{text} (default: %(default)s)',
    )


def add_keystore(parser: argparse.ArgumentParser) -> None:
    """Add the choice of DDS security."""
    parser.add_argument(
        '--secure', type=existing_directory, metavar='KEYSTORE',
        help='keystore of DDS security: nobody takes part without a key, or beyond its rights',
    )


def add_namespace(parser: argparse.ArgumentParser) -> None:
    """Add the choice of a namespace."""
    parser.add_argument(
        '--namespace', type=namespace, default=ROOT, metavar='NAMESPACE',
        help='ROS namespace of all nodes of the graph (default: %(default)s)',
    )


def add_remappings(parser: argparse.ArgumentParser) -> None:
    """Add other names for topics and services."""
    parser.add_argument(
        '--remap', type=remappings, default=(), metavar='FROM:=TO[,FROM:=TO...]',
        help='other names for topics and services of the nodes (default: none)',
    )


def add_peers(parser: argparse.ArgumentParser) -> None:
    """Add the names of other hosts."""
    parser.add_argument(
        '--peer', type=_checked(find_peer), action='append', default=[], metavar='ADDRESS',
        help='another host with a part of the graph: IPv4 or IPv6 address, or name; repeatable',
    )


def add_running_graph(parser: argparse.ArgumentParser) -> None:
    """Add where a running graph is, and how one takes part in it."""
    add_peers(parser)
    add_keystore(parser)
    add_namespace(parser)


def add_part(parser: argparse.ArgumentParser) -> None:
    """Add the choice of a part of the graph."""
    from srnn_bringup.graph import NAMES, part

    parser.add_argument(
        '--only', type=_checked(part), default=(), metavar='NODE[,NODE...]',
        help=f'nodes to start on this host: {", ".join(NAMES)} (default: all)',
    )


def add_view(parser: argparse.ArgumentParser) -> None:
    """Add the live view."""
    parser.add_argument(
        '--view', type=whole(1, 65535), nargs='?', const=VIEW_PORT, metavar='PORT',
        help=f'show the run as a web page of this machine, at PORT (default: {VIEW_PORT})',
    )


def _checked(read: Callable[[str], V]) -> Callable[[str], V]:
    """Return a reader whose errors argparse shows as they are."""

    def reader(text: str) -> V:
        try:
            return read(text)
        except ChoiceError as error:
            raise argparse.ArgumentTypeError(str(error)) from error

    return reader


def whole(minimum: int, maximum: int) -> Callable[[str], int]:
    """Return a reader of whole numbers within bounds."""

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = minimum - 1
        if not minimum <= value <= maximum:
            raise argparse.ArgumentTypeError(
                f'{text!r}: must be a whole number from {minimum} to {maximum}'
            )
        return value

    return read


def namespace(text: str) -> str:
    """Read the name of a namespace; return it with the slash that it begins with."""
    full = f'/{text.removeprefix("/")}'
    if full != ROOT and not _NAMESPACE.fullmatch(full):
        raise argparse.ArgumentTypeError(
            f'{text!r}: must be a ROS namespace: words of letters, digits and underscores, none '
            "of which begins with a digit, with '/' between them"
        )
    return full


def remappings(text: str) -> tuple[tuple[str, str], ...]:
    """Read pairs of the name of a topic or service and the name to use instead."""
    pairs = [_REMAPPING.fullmatch(rule.strip()) for rule in text.split(',')]
    if None in pairs:
        raise argparse.ArgumentTypeError(
            f"{text!r}: must be FROM:=TO, two names of topics or services, with ',' between pairs"
        )
    return tuple((pair[1], pair[2]) for pair in pairs if pair)


def rate(text: str) -> float:
    """Read a learning rate."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value <= 1.0:
        raise argparse.ArgumentTypeError(f'{text!r}: must be a number > 0 and <= 1')
    return value


def existing_file(text: str) -> Path:
    """Read the path of a file that is there."""
    path = Path(text)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f'{text!r}: there is no such file')
    return path


def new_file(text: str) -> Path:
    """Read the path of a file that can be written."""
    path = Path(text)
    if path.is_dir():
        raise argparse.ArgumentTypeError(f'{text!r}: is a directory')
    if not path.resolve().parent.is_dir():
        raise argparse.ArgumentTypeError(f'{text!r}: there is no directory {str(path.parent)!r}')
    return path


def existing_directory(text: str) -> Path:
    """Read the path of a directory that is there."""
    path = Path(text)
    if not path.is_dir():
        raise argparse.ArgumentTypeError(f'{text!r}: there is no such directory')
    return path


def new_directory(text: str) -> Path:
    """Read the path of a directory that is there or can be made."""
    path = Path(text)
    if path.exists() and not path.is_dir():
        raise argparse.ArgumentTypeError(f'{text!r}: is not a directory')
    return path


def new_bag(text: str) -> Path:
    """Read the path of a directory that is not there yet."""
    path = Path(text)
    if path.exists():
        raise argparse.ArgumentTypeError(f'{text!r}: is there already; name a new directory')
    return path


def picture_file(text: str) -> Path:
    """Read the path of a picture that can be written."""
    path = new_file(text)
    if path.suffix not in PICTURE_FORMATS:
        raise argparse.ArgumentTypeError(
            f'{text!r}: must end in one of {", ".join(PICTURE_FORMATS)}'
        )
    return path
