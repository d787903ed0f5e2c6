# SPDX-License-Identifier: Apache-2.0
"""The mark of a message: who sent it, as which of how many, and when it was signed."""

import re
from typing import NamedTuple

CODE_DIGITS = 32
"""Hex digits of an authentication code."""

_TIME = '([0-9a-f]{16})'
_MARK = re.compile(
    rf'{_TIME}\.([1-9][0-9]{{0,18}})(?:\.{_TIME}\.([0-9a-f]{{{CODE_DIGITS}}}))?'
)


class Mark(NamedTuple):
    """Where a message comes from.

    As text: ``source.sequence`` or, sealed, ``source.sequence.signed.code``; source and
    signing time are 16 hex digits, so that they sort as they are.

    Attributes:
        source: when the sender began [ns]; later senders are greater, 0 is nobody.
        sequence: number of the message, from 1, for this topic and sender.
        signed_ns: system time of the signature [ns]; None without a seal.
        code: authentication code in hex digits; empty without a seal.

    """

    source: int
    sequence: int
    signed_ns: int | None = None
    code: str = ''

    def claim(self) -> str:
        """Return the text without the code, which is what the code is about."""
        text = f'{self.source:016x}.{self.sequence}'
        return text if self.signed_ns is None else f'{text}.{self.signed_ns:016x}'

    def text(self) -> str:
        """Return the mark as it travels."""
        return f'{self.claim()}.{self.code}' if self.code else self.claim()


def parse(text: str) -> Mark | None:
    """Return the mark of a text, or None where the text is no mark; never raises.

    Every mark has one text only.
    """
    found = _MARK.fullmatch(text)
    if found is None:
        return None
    source, sequence, signed, code = found.groups()
    if not int(source, 16):
        return None
    if signed is None:
        return Mark(int(source, 16), int(sequence))
    return Mark(int(source, 16), int(sequence), int(signed, 16), code)
