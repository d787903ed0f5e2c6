# SPDX-License-Identifier: Apache-2.0
"""A clock for nodes under test: time passes when somebody sleeps, and not otherwise."""


class SleptClock:
    """Stands in for the module `time`.

    Attributes:
        now: reading of the clock [s].

    """

    def __init__(self) -> None:
        self.now = 100.0

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds
