# SPDX-License-Identifier: Apache-2.0
"""Array layouts whose dimensions carry names, and named figures beside the data.

A figure is a dimension of size 1 labelled ``name=value``: tools that only look at
the sizes still see the right shape.
"""

from collections.abc import Mapping
import math

from std_msgs.msg import MultiArrayDimension, MultiArrayLayout

from srnn_msgs_py.errors import MessageError

MAX_DIMENSIONS = 32
MAX_VALUES = 10_201**2
"""Most values of an array, a third of them learned synapses; more are refused uncopied."""

MAX_WHOLE = 2**63 - 1
_MAX_DIGITS = len(str(MAX_WHOLE))


def to_layout(shape: dict[str, int], figures: dict[str, object]) -> MultiArrayLayout:
    """Return a row-major layout.

    Args:
        shape: size of every dimension, outermost first.
        figures: what else to tell, by name; `str` of it travels.

    """
    dims = []
    stride = 1
    for name, value in reversed(figures.items()):
        label = f'{name}={value}'
        dims.append(MultiArrayDimension(label=label, size=1, stride=stride))
    for name, size in reversed(shape.items()):
        stride *= int(size)
        dims.append(MultiArrayDimension(label=name, size=int(size), stride=stride))
    return MultiArrayLayout(dim=dims[::-1], data_offset=0)


def from_layout(
    layout: MultiArrayLayout, length: int, names: tuple[str, ...]
) -> tuple[tuple[int, ...], dict[str, str]]:
    """Return the sizes and the figures of a layout.

    Args:
        layout: as `to_layout` makes it.
        length: number of values that came with it.
        names: labels that the dimensions must have.

    Returns:
        The sizes of the dimensions and the text of every figure.

    Raises:
        MessageError: the labels or sizes are not as expected, or too large.

    """
    if length > MAX_VALUES:
        raise MessageError(f'data has {length} values: must be <= {MAX_VALUES}')
    if len(layout.dim) > MAX_DIMENSIONS:
        raise MessageError(f'layout has {len(layout.dim)} dims: must be <= {MAX_DIMENSIONS}')
    if layout.data_offset != 0:
        raise MessageError(f'data_offset = {layout.data_offset}: must be 0')
    sizes = [(dim.label, int(dim.size)) for dim in layout.dim if '=' not in dim.label]
    if tuple(label for label, _ in sizes) != names:
        found = ', '.join(repr(label) for label, _ in sizes) or 'none'
        raise MessageError(f'layout has the dims {found}: must be {", ".join(names)}')
    total = 1
    for _, size in sizes:
        total *= size
    if total != length:
        raise MessageError(f'data has {length} values: the layout says {total}')
    figures = dict(dim.label.split('=', 1) for dim in layout.dim if '=' in dim.label)
    return tuple(size for _, size in sizes), figures


def whole(figures: Mapping[str, str], name: str) -> int:
    """Return a figure as a whole number.

    Raises:
        MessageError: it is missing or no whole number >= 0.

    """
    text = figure(figures, name)
    digits = text.isascii() and text.isdecimal() and len(text) <= _MAX_DIGITS
    if not digits or int(text) > MAX_WHOLE:
        raise MessageError(f'{name} = {text[:40]!r}: must be a whole number, 0 to {MAX_WHOLE}')
    return int(text)


def real(figures: Mapping[str, str], name: str) -> float:
    """Return a figure as a number.

    Raises:
        MessageError: it is missing or no finite number.

    """
    text = figure(figures, name)
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise MessageError(f'{name} = {text[:40]!r}: must be a finite number')
    return value


def figure(figures: Mapping[str, str], name: str) -> str:
    """Return a figure as text.

    Raises:
        MessageError: it is missing; the message lists those that came.

    """
    if name not in figures:
        raise MessageError(f'layout lacks {name}=…; it has {", ".join(figures) or "none"}')
    return figures[name]
