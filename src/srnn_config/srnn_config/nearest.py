# SPDX-License-Identifier: Apache-2.0
"""What somebody may have meant who mistyped a name."""

from collections.abc import Iterable
import difflib


def did_you_mean(name: str, valid: Iterable[str]) -> str:
    """Return a hint at the nearest valid name, as part of a line; empty if none is near."""
    near = difflib.get_close_matches(name, list(valid), n=1)
    return f" (did you mean '{near[0]}'?)" if near else ''
