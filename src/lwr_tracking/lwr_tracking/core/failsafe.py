# SPDX-License-Identifier: Apache-2.0
"""From what is wrong to what to do about it: a pure function, the strictest wins."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Flag, IntEnum, auto
from functools import cache
from types import MappingProxyType


class Reaction(IntEnum):
    """What the tracker does, from mild to strict; each includes the ones before.

    REJECT: new segments are refused, motion goes on. SOFT_STOP: come to rest along the
    path. FREEZE: hold the measured tip at once, end what runs, drop what waits.
    """

    NONE = 0
    REJECT = 1
    SOFT_STOP = 2
    FREEZE = 3


class Condition(Flag):
    """What can be wrong, or asked for."""

    NONE = 0
    NOT_STARTED = auto()
    PAUSED = auto()
    CONTACT = auto()
    STOPPED = auto()
    BAD_SAMPLE = auto()
    DIVERGED = auto()
    OUT_OF_RANGE = auto()
    JUMPED = auto()
    FROZEN = auto()
    SILENT = auto()
    JOINT_LIMIT = auto()
    SINGULAR = auto()
    SATURATED = auto()
    REPEATED = auto()
    OVERLOADED = auto()
    LOADED = auto()

    # Members and their combinations are unique: their identity is all the hash that it takes.
    __hash__ = object.__hash__


@dataclass(frozen=True)
class Rule:
    """Answer to one condition.

    Attributes:
        reaction: what to do.
        latches: the reaction stays until a reset, also when the condition has gone.
        cause: the condition in words.

    """

    reaction: Reaction
    latches: bool
    cause: str


RULES: Mapping[Condition, Rule] = MappingProxyType(
    {
        Condition.NOT_STARTED: Rule(Reaction.REJECT, False, 'arm has not reported yet'),
        Condition.PAUSED: Rule(Reaction.SOFT_STOP, False, 'paused'),
        Condition.CONTACT: Rule(Reaction.FREEZE, False, 'contact'),
        Condition.STOPPED: Rule(Reaction.FREEZE, True, 'stop asked for'),
        Condition.BAD_SAMPLE: Rule(Reaction.FREEZE, True, 'measurement is not finite'),
        Condition.DIVERGED: Rule(Reaction.FREEZE, True, 'arm is not where it was commanded'),
        Condition.OUT_OF_RANGE: Rule(
            Reaction.FREEZE, True, 'measured joint angle outside its limits'
        ),
        Condition.JUMPED: Rule(
            Reaction.FREEZE, True, 'measured joint angle changed faster than a joint can move'
        ),
        Condition.FROZEN: Rule(
            Reaction.FREEZE, True, 'measurements do not change though the arm is told to move'
        ),
        Condition.SILENT: Rule(Reaction.FREEZE, True, 'no joint states'),
        Condition.JOINT_LIMIT: Rule(Reaction.FREEZE, True, 'joint at its limit'),
        Condition.SINGULAR: Rule(Reaction.FREEZE, True, 'posture almost singular'),
        Condition.SATURATED: Rule(
            Reaction.FREEZE, True, 'joint at its limit of speed or torque'
        ),
        Condition.REPEATED: Rule(
            Reaction.FREEZE, True, 'contact at the same place again and again'
        ),
        Condition.OVERLOADED: Rule(
            Reaction.SOFT_STOP, False, 'measurements are answered too late'
        ),
        Condition.LOADED: Rule(
            Reaction.REJECT, False, 'force on the tip at rest: contact could not be told'
        ),
    }
)


@dataclass(frozen=True)
class Decision:
    """What a set of conditions demands; what is asked for in every tick is there at once.

    Attributes:
        conditions: all of them.
        reaction: the strictest of all reactions.
        latched: the conditions that stay until a reset.
        until_reset: there are some of these.
        causes: all conditions in words, the strictest first.

    """

    conditions: frozenset[Condition]
    reaction: Reaction
    latched: Condition
    until_reset: bool
    causes: tuple[str, ...]


def markdown_table() -> str:
    """Return all rules, the strictest first, as a table."""
    rows = ['| condition | cause, in words | reaction | until |', '|---|---|---|---|']
    for condition, rule in sorted(RULES.items(), key=lambda item: -item[1].reaction):
        until = 'reset' if rule.latches else 'it has gone'
        rows.append(f'| {condition.name} | {rule.cause} | {rule.reaction.name} | {until} |')
    return '\n'.join(rows)


@cache
def decide(conditions: Condition) -> Decision:
    """Return the answer to all conditions together."""
    rules = sorted(
        ((c, RULES[c]) for c in conditions), key=lambda item: -item[1].reaction
    )
    latched = Condition.NONE
    for condition, rule in rules:
        if rule.latches:
            latched |= condition
    reaction = rules[0][1].reaction if rules else Reaction.NONE
    causes = tuple(rule.cause for _, rule in rules)
    return Decision(frozenset(conditions), reaction, latched, bool(latched), causes)
