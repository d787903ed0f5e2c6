# SPDX-License-Identifier: Apache-2.0
"""Every field of a message as bytes that are the same for sender and listener.

Serialized messages will not do: what the middleware puts between and behind the fields
is not defined. Hosts must have the same byte order, as all have on which ROS 2 runs.
"""

from collections.abc import Callable, Iterator
from functools import cache
from operator import attrgetter
import re
import struct
from typing import Any

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros.message_type import message_type

Encode = Callable[[Any], bytes]

_NUMBERS = {
    'boolean': '?', 'octet': 'c', 'float': 'f', 'double': 'd',
    'int8': 'b', 'int16': 'h', 'int32': 'i', 'int64': 'q',
    'uint8': 'B', 'uint16': 'H', 'uint32': 'I', 'uint64': 'Q',
}  # fmt: skip
_LISTED = ('boolean', 'octet')
"""Sequences of these are lists, those of other numbers are arrays."""

_SEQUENCE = re.compile(r'sequence<([^,]+)(?:, \d+)?>|(.+)\[\d+\]')
_COUNT = struct.Struct('<Q').pack


def canonical(msg: Any) -> bytes:
    """Return all fields of a message; two messages have equal bytes if they are equal.

    Numbers come first, then whatever has a length, with that in front.

    Raises:
        MessageError: a field has a type that no message here has.

    """
    kind: Any = type(msg)
    return _message(kind)(msg)


@cache
def _message(cls: Any) -> Encode:
    fields = dict(_fields(cls))
    numbers = [path for path, text in fields.items() if text in _NUMBERS]
    others = [path for path in fields if path not in numbers]
    pack = struct.Struct('<' + ''.join(_NUMBERS[fields[path]] for path in numbers)).pack
    encoders = tuple(_encoder(fields[path]) for path in others)
    fixed, varying = _getter(numbers), _getter(others)

    def encode(msg: Any) -> bytes:
        parts = [e(v) for e, v in zip(encoders, varying(msg), strict=True)]
        return pack(*fixed(msg)) + b''.join(parts)

    return encode


def _fields(cls: Any) -> Iterator[tuple[str, str]]:
    """Yield path and type of every field, those of messages within the message included."""
    for name, text in cls.get_fields_and_field_types().items():
        if '/' in text and not _SEQUENCE.fullmatch(text):
            for path, inner in _fields(_class(text)):
                yield f'{name}.{path}', inner
        else:
            yield name, text


def _getter(paths: list[str]) -> Callable[[Any], tuple[Any, ...]]:
    if not paths:
        return lambda msg: ()
    get = attrgetter(*paths)
    return get if len(paths) > 1 else lambda msg: (get(msg),)


def _encoder(text: str) -> Encode:
    if text == 'string':
        return _string
    found = _SEQUENCE.fullmatch(text)
    if found is None:
        raise MessageError(f'a field of type {text!r} cannot be turned into bytes')
    inner = found[1] or found[2]
    if inner in _NUMBERS and inner not in _LISTED:
        return lambda values: _COUNT(len(values)) + values.tobytes()
    encode = _element(inner)
    return lambda values: _COUNT(len(values)) + b''.join([encode(v) for v in values])


def _element(text: str) -> Encode:
    if text in _NUMBERS:
        return struct.Struct(f'<{_NUMBERS[text]}').pack
    return _message(_class(text)) if '/' in text else _encoder(text)


def _class(text: str) -> Any:
    package, name = text.split('/')
    return message_type(f'{package}/msg/{name}')


def _string(value: str) -> bytes:
    data = value.encode('utf-8', 'surrogatepass')
    return _COUNT(len(data)) + data
