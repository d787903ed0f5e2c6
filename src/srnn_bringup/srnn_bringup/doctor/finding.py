# SPDX-License-Identifier: Apache-2.0
"""One thing that was looked at."""

from dataclasses import dataclass
from enum import Enum


class Verdict(Enum):
    """How bad a finding is."""

    OK = 'OK'
    WARN = 'WARN'
    """It works, but worse, or with a risk."""
    FAIL = 'FAIL'
    """Something that is needed does not work."""


@dataclass(frozen=True)
class Finding:
    """One thing that was looked at.

    Attributes:
        subject: what was looked at.
        verdict: how bad it is.
        words: what was found.
        advice: what to do about it; empty if nothing is to be done.

    """

    subject: str
    verdict: Verdict
    words: str
    advice: str = ''

    def line(self) -> str:
        """Return the finding in one line."""
        advice = f'; to do: {self.advice}' if self.advice else ''
        return f'{self.verdict.value:<4}  {self.subject:<22} {self.words}{advice}'

    def document(self) -> dict[str, str]:
        """Return the finding as plain data for JSON."""
        return {
            'subject': self.subject,
            'verdict': self.verdict.value,
            'found': self.words,
            'advice': self.advice,
        }


def judged(bad: bool, subject: str, words: str, advice: str) -> Finding:
    """Return a warning with advice if something is bad, else that it is well."""
    if bad:
        return Finding(subject, Verdict.WARN, words, advice)
    return Finding(subject, Verdict.OK, words)
