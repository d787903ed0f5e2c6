# SPDX-License-Identifier: Apache-2.0
"""The five ways in which topics of the workspace travel, by name."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Qos:
    """Quality of service, always keep-last.

    Attributes:
        name: how the topic table refers to it.
        reliable: lost samples are sent again.
        latched: late subscribers get the last sample (transient local).
        depth: samples kept.

    """

    name: str
    reliable: bool
    latched: bool
    depth: int

    def words(self) -> str:
        """Return the profile as the README prints it."""
        reliability = 'reliable' if self.reliable else 'best effort'
        durability = ', transient local' if self.latched else ''
        return f'{reliability}{durability}, depth {self.depth}'


# Depth 1 on whatever moves the arm: a deeper reliable history replays old commands
# after an interruption of the link.
MOTION = Qos('motion', reliable=True, latched=False, depth=1)
LATCHED = Qos('latched', reliable=True, latched=True, depth=1)
EVENT = Qos('event', reliable=True, latched=False, depth=10)
SENSOR = Qos('sensor', reliable=False, latched=False, depth=1)
# Deep enough that a recorder which is found late misses nothing of the first seconds.
HISTORY = Qos('history', reliable=True, latched=True, depth=100)

PROFILES = {profile.name: profile for profile in (MOTION, LATCHED, EVENT, SENSOR, HISTORY)}
