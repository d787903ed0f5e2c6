# SPDX-License-Identifier: Apache-2.0
"""The configuration of a graph of which nothing was chosen, where it can be read."""

from typing import TYPE_CHECKING

from srnn_bringup.choices import Choices
from srnn_bringup.doctor.finding import Finding, Verdict
from srnn_bringup.errors import BringupError
from srnn_config import ConfigError

if TYPE_CHECKING:
    from srnn_bringup.config import Configuration

SUBJECT = 'configuration'


def defaults() -> 'Configuration | Finding':
    """Return what the nodes would be told, or what is wrong with it."""
    try:
        from srnn_bringup.config import load
    except Exception as error:  # a library is missing or broken
        advice = 'first mend what cannot be imported'
        return Finding(SUBJECT, Verdict.FAIL, f'cannot be read: {error}', advice)
    try:
        return load(Choices())
    except (BringupError, ConfigError) as error:
        return Finding(SUBJECT, Verdict.FAIL, str(error), 'correct this file, or restore it')
