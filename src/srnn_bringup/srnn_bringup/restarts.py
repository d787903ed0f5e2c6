# SPDX-License-Identifier: Apache-2.0
"""When a node that has died is started anew: at once, then later and later."""

FIRST_S = 0.1
"""Pause before the first restart [s]."""

LONGEST_S = 10.0
"""Longest pause; with every death in a row it doubles up to here [s]."""

STEADY_S = 10.0
"""Who lives for this long starts with the first pause again [s]."""


class Restarts:
    """Pauses before restarts, per node; all times in seconds of one steady clock."""

    def __init__(self) -> None:
        """Nobody has died yet."""
        self._due: dict[str, float] = {}
        self._last: dict[str, float] = {}
        self._pause: dict[str, float] = {}

    def died(self, name: str, now: float) -> float:
        """Take in a death; return the pause until the restart [s]."""
        pause = self._pause.get(name, 0.0)
        fresh = not pause or now - self._last[name] > STEADY_S
        pause = FIRST_S if fresh else min(2.0 * pause, LONGEST_S)
        self._pause[name], self._last[name] = pause, now + pause
        self._due[name] = now + pause
        return pause

    def waits(self, name: str) -> bool:
        """Tell whether the restart of a node is still to come."""
        return name in self._due

    def due(self, now: float) -> list[str]:
        """Return who is to be started now, once."""
        names = [name for name, time in self._due.items() if time <= now]
        for name in names:
            del self._due[name]
        return names
