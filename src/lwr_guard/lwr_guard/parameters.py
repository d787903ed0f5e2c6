# SPDX-License-Identifier: Apache-2.0
"""Parameters of the guard."""

from dataclasses import dataclass

from srnn_config import Parameters, parameter


@dataclass(frozen=True)
class GuardParameters(Parameters):
    """What a stream of joint commands must keep to."""

    period: float = parameter(
        0.004, unit='s', minimum=0.001, maximum=0.1, doc='Expected time between commands.'
    )
    silence: float = parameter(
        0.02, unit='s', minimum=0.001, maximum=0.1,
        doc='Without a good command for this long the arm holds its pose; nor does a longer '
        'pause allow a longer step.',
    )

    def check(self) -> None:
        """Refuse a silence shorter than one period."""
        if self.silence < self.period:
            raise self.refuse('silence', self.silence, f'>= period = {self.period:g} s')
