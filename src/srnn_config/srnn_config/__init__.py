# SPDX-License-Identifier: Apache-2.0
"""Validated parameter sets and scene files; pure Python, no middleware."""

from srnn_config.errors import (
    ConfigError,
    ConfigFileError,
    ParameterError,
    UnknownKeyError,
)
from srnn_config.fields import Parameters, ParameterSpec, parameter
from srnn_config.loading import build, read_yaml, to_mapping

__all__ = [
    'ConfigError',
    'ConfigFileError',
    'ParameterError',
    'ParameterSpec',
    'Parameters',
    'UnknownKeyError',
    'build',
    'parameter',
    'read_yaml',
    'to_mapping',
]
