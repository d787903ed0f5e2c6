# SPDX-License-Identifier: Apache-2.0
"""Errors of the configuration package: one base, one class per mistake."""

from collections.abc import Iterable

from srnn_config.nearest import did_you_mean


class ConfigError(Exception):
    """Base of every error that a configuration can cause."""


class ParameterError(ConfigError, ValueError):
    """A known parameter has a value of the wrong type or outside its bounds."""


class ConfigFileError(ConfigError, OSError):
    """A configuration file is missing, unreadable, too large or not YAML."""


class UnknownKeyError(ConfigError, ValueError):
    """A key that no parameter set knows; the message lists those it does."""

    def __init__(self, where: str, key: object, valid: Iterable[str]) -> None:
        """Name the place, the key and the valid keys, the nearest one first."""
        self.key = key
        self.valid = tuple(valid)
        hint = did_you_mean(str(key), self.valid)
        valid_keys = ', '.join(self.valid)
        super().__init__(f"{where}: unknown key '{key}'{hint}; valid keys: {valid_keys}")
