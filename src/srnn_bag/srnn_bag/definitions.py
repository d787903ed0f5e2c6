# SPDX-License-Identifier: Apache-2.0
"""What messages of a type look like, in the words that a bag carries with it."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
import json
import os
from pathlib import Path
import re
import sys

from srnn_bag.errors import UnknownTypeError

PREFIXES = 'AMENT_PREFIX_PATH'

SEPARATOR = '=' * 80
"""Line between the definitions of a type and of those it is made of."""

_PLAIN = frozenset((
    'bool', 'byte', 'char', 'float32', 'float64', 'string', 'wstring',
    *(f'{sign}int{bits}' for sign in ('', 'u') for bits in (8, 16, 32, 64)),
))  # fmt: skip
_FIELD = re.compile(r'([A-Za-z][\w/]*)(?:<=\d+)?(?:\[[^]]*\])?\s+\w+')


@dataclass(frozen=True)
class Definition:
    """The definition of a message type.

    Attributes:
        type_name: for example ``std_msgs/msg/Header``.
        text: its .msg file and those of the types in it, as a schema `ros2msg` of MCAP.
        digest: hash of the type by REP-2011, empty if its package does not tell.

    """

    type_name: str
    text: str
    digest: str


@cache
def definition(type_name: str) -> Definition:
    """Return the definition of a type of an installed package.

    Raises:
        UnknownTypeError: no installed package has it, or a type that it is made of.

    """
    texts = {type_name: _read(type_name)}
    waiting = [type_name]
    while waiting:
        outer = waiting.pop(0)
        for inner in _inner_types(outer, texts[outer]):
            if inner not in texts:
                texts[inner] = _read(inner)
                waiting.append(inner)
    own = texts.pop(type_name)
    parts = [own] + [f'MSG: {_short(name)}\n{text}' for name, text in texts.items()]
    return Definition(type_name, f'{SEPARATOR}\n'.join(parts), _digest(type_name))


def _inner_types(outer: str, text: str) -> Iterator[str]:
    package = outer.partition('/')[0]
    for line in text.splitlines():
        match = _FIELD.match(line.partition('#')[0].strip())
        if match is None or match[1] in _PLAIN:
            continue
        owner, _, name = match[1].rpartition('/')
        yield f'{owner.partition("/")[0] or package}/msg/{name}'


def _read(type_name: str) -> str:
    text = _file(type_name, '.msg').read_text(encoding='utf-8')
    return text if text.endswith('\n') else f'{text}\n'


def _digest(type_name: str) -> str:
    try:
        content = json.loads(_file(type_name, '.json').read_text(encoding='utf-8'))
        hashes = {entry['type_name']: entry['hash_string'] for entry in content['type_hashes']}
        return str(hashes[type_name])
    except (UnknownTypeError, KeyError, TypeError, ValueError):
        return ''


def _file(type_name: str, suffix: str) -> Path:
    package, _, name = type_name.partition('/msg/')
    prefixes = [*filter(None, os.environ.get(PREFIXES, '').split(os.pathsep)), sys.prefix]
    for prefix in prefixes:
        file = Path(prefix, 'share', package, 'msg', f'{name}{suffix}')
        if file.is_file():
            return file
    raise UnknownTypeError(f'{type_name!r} is no message type of an installed package')


def _short(type_name: str) -> str:
    return type_name.replace('/msg/', '/')
