# SPDX-License-Identifier: Apache-2.0
"""YAML files and mappings into parameter sets, all or nothing."""

from collections.abc import Mapping
import dataclasses
from pathlib import Path
from typing import Any, TypeVar, get_type_hints

from srnn_config.errors import ConfigFileError, ParameterError, UnknownKeyError
from srnn_config.fields import Parameters, is_required, spec_of
from srnn_config.regular_file import read_regular

P = TypeVar('P', bound=Parameters)

MAX_FILE_BYTES = 1_000_000


def read_yaml(path: str | Path) -> dict[str, Any]:
    """Read a YAML mapping as plain data.

    Args:
        path: file to read, at most `MAX_FILE_BYTES` long.

    Raises:
        ConfigFileError: the file is missing, no regular file, too large, not YAML, beyond
            the limits of `plain_yaml`, or no mapping.

    """
    # Where PyYAML is missing, what needs no file works nevertheless.
    from srnn_config.plain_yaml import parse

    try:
        text = read_regular(path, MAX_FILE_BYTES).decode('utf-8')
    except UnicodeDecodeError as error:
        raise ConfigFileError(f'{path}: cannot be read: {error}') from error
    data = parse(text, str(path))
    if not isinstance(data, dict):
        raise ConfigFileError(f'{path}: must hold a mapping of keys to values')
    return data


def build(cls: type[P], data: Mapping[str, Any], where: str) -> P:
    """Build a parameter set, nested sets included, from a mapping.

    Args:
        cls: frozen dataclass derived from `Parameters`.
        data: keys are field names; fields left out keep their default.
        where: what to call the source in error messages, for example a file name.

    Raises:
        UnknownKeyError: a key names no field; the message lists the valid ones.
        ParameterError: a value is missing, of the wrong type or out of bounds.

    """
    if not isinstance(data, Mapping):
        raise ParameterError(f'{where}: must be a mapping of keys to values, not {data!r}')
    hints = get_type_hints(cls)
    fields = {f.name: f for f in dataclasses.fields(cls)}  # type: ignore[arg-type]
    values: dict[str, Any] = {}
    for key, value in data.items():
        if key not in fields:
            raise UnknownKeyError(where, key, fields)
        nested = spec_of(fields[key]) is None
        values[key] = build(hints[key], value, f'{where}.{key}') if nested else value
    missing = [f.name for f in fields.values() if is_required(f) and f.name not in values]
    if missing:
        raise ParameterError(f'{where}: missing {", ".join(missing)}')
    try:
        return cls(**values)
    except ParameterError as error:
        raise ParameterError(f'{where}: {error}') from None


def to_mapping(parameters: Parameters) -> dict[str, Any]:
    """Return the values as nested plain data; `build` of it gives an equal set."""
    return _plain(dataclasses.asdict(parameters))  # type: ignore[call-overload,no-any-return]


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    if isinstance(value, (tuple, list)):
        return [_plain(v) for v in value]
    return value
