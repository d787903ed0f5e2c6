# SPDX-License-Identifier: Apache-2.0
"""YAML as plain data: no objects, no aliases, bounded depth and size."""

from typing import Any

import yaml

from srnn_config.errors import ConfigFileError

MAX_DEPTH = 20
MAX_SCALAR = 1000
"""Longest key or value; numbers with more digits take Python minutes to read."""


class _PlainLoader(yaml.SafeLoader):  # type: ignore[misc]  # yaml is not typed
    """Refuses what can make a small file large: aliases, deep nesting, endless scalars."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._depth = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        if self.check_event(yaml.AliasEvent):
            raise yaml.MarkedYAMLError(
                problem='an alias: write the value out', problem_mark=self.peek_event().start_mark
            )
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise yaml.YAMLError(f'nested deeper than {MAX_DEPTH} levels')
        node = super().compose_node(parent, index)
        self._depth -= 1
        return node

    def compose_scalar_node(self, anchor: Any) -> Any:
        length = len(self.peek_event().value)
        if length > MAX_SCALAR:
            raise yaml.YAMLError(f'a value of {length} characters: at most {MAX_SCALAR}')
        return super().compose_scalar_node(anchor)


def parse(text: str, where: str) -> Any:
    """Return what a YAML text says.

    Args:
        text: one document.
        where: what to call the source in error messages.

    Raises:
        ConfigFileError: not YAML, or beyond the limits.

    """
    loader = None
    try:
        loader = _PlainLoader(text)
        return loader.get_single_data()
    # An impossible date or number in it is a ValueError.
    except (yaml.YAMLError, ValueError) as error:
        raise ConfigFileError(f'{where}: not valid YAML: {_words(error)}') from error
    finally:
        if loader is not None:
            loader.dispose()


def _words(error: Exception) -> str:
    """Return in one line what is wrong, and where."""
    mark = getattr(error, 'problem_mark', None)
    if mark is None:
        return ' '.join(str(error).split())
    return f'line {mark.line + 1}, column {mark.column + 1}: {getattr(error, "problem", error)}'
