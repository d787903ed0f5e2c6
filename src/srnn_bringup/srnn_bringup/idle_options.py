# SPDX-License-Identifier: Apache-2.0
"""Options that would change nothing are refused: whoever gives one expects something of it."""

import argparse
from collections.abc import Mapping
from typing import Any

from srnn_bringup.errors import ChoiceError


def refuse_idle(options: argparse.Namespace, defaults: Mapping[str, Any], why: str) -> None:
    """Refuse options that are not as if they had not been given.

    Args:
        options: what was given.
        defaults: options that change nothing now, with their defaults.
        why: when they do that, as `without --publish`.

    Raises:
        ChoiceError: there is one; the message names it and its value.

    """
    for name, default in defaults.items():
        value = getattr(options, name)
        if value != default:
            shown = value[0] if isinstance(value, list) else value
            shown = '='.join(map(str, shown)) if isinstance(shown, tuple) else shown
            raise ChoiceError(f'--{name.replace("_", "-")} {shown} has no effect {why}')
