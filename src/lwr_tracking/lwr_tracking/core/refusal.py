# SPDX-License-Identifier: Apache-2.0
"""Why a segment was not executed, by name."""

from enum import StrEnum

NOT_IN_CHARGE = 'another planner is in charge'
"""Reason for a planner whose segments are not looked at while those of another are."""


class Refusal(StrEnum):
    """The reasons that a REJECTED or STALE result can carry."""

    FRAME = 'unknown frame'
    SHAPE = 'arrays of unequal length or not planar'
    KNOTS = 'too few or too many knots'
    NOT_FINITE = 'a value is not finite'
    TIMES = 'times do not increase from 0'
    STALE = 'too old'
    DUPLICATE = 'already accepted'
    OUT_OF_ORDER = 'older than an accepted segment'
    START_POSITION = 'starts away from the reference'
    START_VELOCITY = 'starts with another velocity than the reference'
    LATE = 'late: the reference already brakes'
    OUTSIDE = 'leaves the workspace'
    SPEED = 'too fast'
    ACCELERATION = 'accelerates too much'
    JUMP = 'positions do not fit the velocities'
    NO_ROOM = 'too short to come to rest at its end'
    NOT_STARTED = 'the arm has not reported yet'
    LOADED = 'the tip is loaded at rest'
    PAUSED = 'paused'
    STOPPED = 'stopped until reset'
    SUPERSEDED = 'superseded'
    CONTACT = 'dropped after a contact'
