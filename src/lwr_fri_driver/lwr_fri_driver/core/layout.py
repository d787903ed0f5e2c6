# SPDX-License-Identifier: Apache-2.0
"""Frozen dataclasses as little-endian bytes: every field says where in the datagram it lies."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, fields
from enum import Enum
import struct
from typing import Any, Generic, TypeVar

from lwr_fri_driver.errors import DatagramError

T = TypeVar('T')

_WIRE = 'wire'
_PART = 'part'


@dataclass(frozen=True)
class Place:
    """Where a field lies and how it is written.

    Attributes:
        offset: first byte, from the beginning of the datagram.
        code: of one value: H u16, I u32, i i32, f float32.
        count: how many values; one is a number, more are a tuple.
        kind: what a number means, if it is one of few.

    """

    offset: int
    code: str
    count: int = 1
    kind: type[Enum] | None = None


def wire(
    offset: int, code: str, count: int = 1, kind: type[Enum] | None = None, default: Any = None
) -> Any:
    """Return a dataclass field that lies at `offset`; without a default it is all zeros."""
    if default is None:
        default = (0.0 if code == 'f' else 0,) * count if count > 1 else 0
    return field(default=default, metadata={_WIRE: Place(offset, code, count, kind)})


def part(cls: type[T]) -> Any:
    """Return a dataclass field that is a group of fields."""
    return field(default_factory=cls, metadata={_PART: cls})


class Layout(Generic[T]):
    """Writes and reads one kind of datagram.

    Attributes:
        size: of the datagram [bytes].
        places: of every field, by name.

    """

    def __init__(self, cls: type[T], size: int) -> None:
        """Lay out `cls`.

        Raises:
            DatagramError: the places overlap, leave a gap, or do not fill `size` bytes.

        """
        self._cls = cls
        self.size = size
        self.places = dict(_places(cls))
        self._struct = struct.Struct('<' + ''.join(
            f'{place.count}{place.code}' for place in self.places.values()
        ))  # fmt: skip
        self._check()
        self._build, _ = _builder(cls, 0)

    def pack(self, value: T) -> bytes:
        """Return the datagram of `value`.

        Raises:
            DatagramError: a number does not fit into its field, or a tuple has another length.

        """
        values = list(_values(value))
        try:
            return self._struct.pack(*values)
        except (struct.error, OverflowError) as error:
            raise DatagramError(f'{self._cls.__name__}: {error}') from error

    def unpack(self, data: bytes) -> T:
        """Return what is in a datagram.

        Raises:
            DatagramError: the size is another, or a number is none of the few it may be.

        """
        if len(data) != self.size:
            raise DatagramError(
                f'{self._cls.__name__}: {len(data)} bytes: must be {self.size}'
            )
        value: T = self._build(self._struct.unpack(data))
        return value

    def _check(self) -> None:
        expected = 0
        for name, place in self.places.items():
            if place.offset != expected:
                raise DatagramError(f'{name}: offset {place.offset}: must be {expected}')
            expected += place.count * struct.calcsize('<' + place.code)
        if expected != self.size:
            raise DatagramError(
                f'{self._cls.__name__}: the fields have {expected} bytes: must be {self.size}'
            )


def _places(cls: type[Any], prefix: str = '') -> Iterator[tuple[str, Place]]:
    for item in fields(cls):
        name = prefix + item.name
        if _PART in item.metadata:
            yield from _places(item.metadata[_PART], f'{name}.')
        else:
            yield name, item.metadata[_WIRE]


def _values(value: Any) -> Iterator[Any]:
    for item in fields(value):
        inner = getattr(value, item.name)
        if _PART in item.metadata:
            yield from _values(inner)
        elif item.metadata[_WIRE].count > 1:
            yield from inner
        else:
            yield inner.value if isinstance(inner, Enum) else inner


def _builder(cls: type[Any], start: int) -> tuple[Callable[[tuple[Any, ...]], Any], int]:
    """Return what makes a `cls` of all values of a datagram, and where its own ones end."""
    readers: list[Callable[[tuple[Any, ...]], Any]] = []
    for item in fields(cls):
        if _PART in item.metadata:
            reader, start = _builder(item.metadata[_PART], start)
        else:
            reader, start = _reader(item.name, item.metadata[_WIRE], start)
        readers.append(reader)
    return lambda values: cls(*[read(values) for read in readers]), start


def _reader(name: str, place: Place, start: int) -> tuple[Callable[[Any], Any], int]:
    end = start + place.count
    if place.count > 1:
        return lambda values: values[start:end], end
    if place.kind is None:
        return lambda values: values[start], end
    members = {member.value: member for member in place.kind}
    known = ', '.join(f'{number} {member.name}' for number, member in members.items())

    def read(values: tuple[Any, ...]) -> Enum:
        try:
            return members[values[start]]
        except KeyError:
            raise DatagramError(f'{name} = {values[start]}: must be one of {known}') from None

    return read, end
