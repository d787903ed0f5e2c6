# SPDX-License-Identifier: Apache-2.0
"""Parameters as frozen dataclasses whose fields carry bounds, unit and a sentence."""

from collections.abc import Sequence
import dataclasses
from dataclasses import dataclass
import math
from typing import Any, get_args, get_origin, get_type_hints

from srnn_config.errors import ParameterError

_KEY = 'parameter'


@dataclass(frozen=True)
class ParameterSpec:
    """What a user may read about one parameter, and what its value must obey."""

    doc: str
    unit: str
    minimum: float | None
    maximum: float | None
    above: float | None
    choices: tuple[Any, ...] | None
    length: int | None

    def bounds(self) -> str:
        """Return the valid values in words, for error messages and descriptions."""
        if self.choices is not None:
            return 'one of ' + ', '.join(str(c) for c in self.choices)
        parts = []
        if self.above is not None:
            parts.append(f'> {self.above:g}')
        if self.minimum is not None:
            parts.append(f'>= {self.minimum:g}')
        if self.maximum is not None:
            parts.append(f'<= {self.maximum:g}')
        text = ' and '.join(parts) if parts else 'finite'
        return f'{self.length} values, each {text}' if self.length is not None else text


def parameter(
    default: Any = dataclasses.MISSING,
    *,
    doc: str,
    unit: str = '',
    minimum: float | None = None,
    maximum: float | None = None,
    above: float | None = None,
    choices: Sequence[Any] | None = None,
    length: int | None = None,
) -> Any:
    """Declare one dataclass field with its meaning and its bounds.

    Args:
        default: value when the user gives none; without it the field is required.
        doc: one sentence for the user.
        unit: SI unit of the value, empty when it has none.
        minimum: smallest valid value (inclusive).
        maximum: largest valid value (inclusive).
        above: largest invalid small value (exclusive lower bound).
        choices: the only valid values.
        length: number of elements of a tuple; None accepts any number.

    """
    spec = ParameterSpec(
        doc, unit, minimum, maximum, above, tuple(choices) if choices else None, length
    )
    return dataclasses.field(default=default, metadata={_KEY: spec})


def spec_of(field: dataclasses.Field[Any]) -> ParameterSpec | None:
    """Return the specification of a field, or None for a nested parameter set."""
    spec = field.metadata.get(_KEY)
    return spec if isinstance(spec, ParameterSpec) else None


def is_required(field: dataclasses.Field[Any]) -> bool:
    """Tell whether a field has no default: the user has to give it."""
    return (
        field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
    )


class Parameters:
    """Base of every parameter set: checks all of its fields once, at construction.

    Derive with ``@dataclass(frozen=True)``. Override `check` for rules that
    concern several fields; raise `ParameterError` through `refuse`.
    """

    def __post_init__(self) -> None:
        """Coerce harmless types, then refuse whatever breaks its bounds."""
        hints = get_type_hints(type(self))
        for field in dataclasses.fields(self):  # type: ignore[arg-type]
            spec = spec_of(field)
            if spec is None:
                continue
            value = _coerce(self, field.name, getattr(self, field.name), hints[field.name], spec)
            object.__setattr__(self, field.name, value)
        self.check()

    def check(self) -> None:
        """Refuse combinations of values that are impossible together."""

    def refuse(self, name: str, value: object, valid: str) -> ParameterError:
        """Build the error that names the field, its value and the valid choices."""
        return ParameterError(f'{type(self).__name__}.{name} = {value!r}: must be {valid}')


def _coerce(owner: Parameters, name: str, value: Any, hint: Any, spec: ParameterSpec) -> Any:
    unit = f' [{spec.unit}]' if spec.unit else ''
    valid = spec.bounds() + unit
    if get_origin(hint) is tuple:
        return _coerce_tuple(owner, name, value, hint, spec, valid)
    value = _scalar(owner, name, value, hint, valid)
    _within(owner, name, value, spec, valid)
    return value


def _coerce_tuple(
    owner: Parameters, name: str, value: Any, hint: Any, spec: ParameterSpec, valid: str
) -> tuple[Any, ...]:
    if isinstance(value, str) or not hasattr(value, '__iter__'):
        raise owner.refuse(name, value, f'a list: {valid}')
    element = get_args(hint)[0]
    items = tuple(_scalar(owner, name, v, element, valid) for v in value)
    if spec.length is not None and len(items) != spec.length:
        raise owner.refuse(name, value, valid)
    for item in items:
        _within(owner, name, item, spec, valid)
    return items


def _scalar(owner: Parameters, name: str, value: Any, hint: Any, valid: str) -> Any:
    if hint is bool:
        if not isinstance(value, bool):
            raise owner.refuse(name, value, 'true or false')
        return value
    if hint is str:
        if not isinstance(value, str):
            raise owner.refuse(name, value, f'a text: {valid}')
        return value
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise owner.refuse(name, value, f'a number: {valid}')
    if hint is int:
        if int(value) != value:
            raise owner.refuse(name, value, f'a whole number: {valid}')
        return int(value)
    return float(value)


def _within(owner: Parameters, name: str, value: Any, spec: ParameterSpec, valid: str) -> None:
    if spec.choices is not None and value not in spec.choices:
        raise owner.refuse(name, value, valid)
    if isinstance(value, (bool, str)):
        return
    outside = (
        not math.isfinite(value)
        or (spec.minimum is not None and value < spec.minimum)
        or (spec.maximum is not None and value > spec.maximum)
        or (spec.above is not None and value <= spec.above)
    )
    if outside:
        raise owner.refuse(name, value, valid)
