# SPDX-License-Identifier: Apache-2.0
"""Command line values that are checked before anything starts."""

import argparse
from collections.abc import Callable
import math
from pathlib import Path

PICTURE_FORMATS = ('.png', '.pdf', '.svg')


def whole(minimum: int, maximum: int) -> Callable[[str], int]:
    """Return a reader of whole numbers within bounds."""

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = minimum - 1
        if not minimum <= value <= maximum:
            raise argparse.ArgumentTypeError(
                f'{text!r}: must be a whole number from {minimum} to {maximum}'
            )
        return value

    return read


def rate(text: str) -> float:
    """Read a learning rate."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value <= 1.0:
        raise argparse.ArgumentTypeError(f'{text!r}: must be a number > 0 and <= 1')
    return value


def existing_file(text: str) -> Path:
    """Read the path of a file that is there."""
    path = Path(text)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f'{text!r}: there is no such file')
    return path


def new_file(text: str) -> Path:
    """Read the path of a file that can be written."""
    path = Path(text)
    if path.is_dir():
        raise argparse.ArgumentTypeError(f'{text!r}: is a directory')
    if not path.resolve().parent.is_dir():
        raise argparse.ArgumentTypeError(f'{text!r}: there is no directory {str(path.parent)!r}')
    return path


def picture_file(text: str) -> Path:
    """Read the path of a picture that can be written."""
    path = new_file(text)
    if path.suffix not in PICTURE_FORMATS:
        raise argparse.ArgumentTypeError(
            f'{text!r}: must end in one of {", ".join(PICTURE_FORMATS)}'
        )
    return path
