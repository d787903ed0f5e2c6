# SPDX-License-Identifier: Apache-2.0
"""Rows 8 to 13: whatever arrives as a segment, a bad one changes nothing, bit for bit."""

from arm_rig import PERIOD, Rig
from garbage_segments import GARBAGE
from moving_arm import generator, random_course, speeds
import numpy as np
import pytest
from segments import MS, line

from lwr_tracking.core.refusal import Refusal
from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.result import ResultCode
from srnn_msgs_py.ros import segment as segment_message
from srnn_msgs_py.segment import Segment

TICKS = 60
OFFERS = 3
"""So many bad segments come in every tick: 19 faults x 3 repeats x 60 ticks are 10 260."""


def trace(made: Rig, attack=lambda: None) -> bytes:
    """Advance one cycle after an attack; return command, reference and state of the arm."""
    attack()
    made.tick()
    reference = made.tracker.reference
    motion = made.arm.data.qpos, made.arm.data.qvel, reference.position, reference.velocity
    clock = np.float64(reference.clock)
    return b''.join(part.tobytes() for part in (made.commands[-1], *motion, clock))


@pytest.mark.parametrize('what', GARBAGE)
def test_a_bad_segment_changes_nothing(ledger, what):
    garbage = GARBAGE[what]
    for repeat in range(ledger.repeats):
        rng = generator(what, repeat)
        course = random_course(rng)
        good = course.continued(rng)
        with ledger.injection(garbage.row, what, bound_ms=2.0) as entry:
            clean, attacked = course.begin(), course.begin()

            def attack(attacked=attacked, good=good, rng=rng):
                for _ in range(OFFERS):
                    segment, age = garbage.spoil(good, rng)
                    told = attacked.tracker.offer(segment, age)
                    assert told.reason in garbage.refusals
                    stale = told.reason == Refusal.STALE
                    assert told.code is (ResultCode.STALE if stale else ResultCode.REJECTED)
                    assert told.stamp_ns == segment.stamp_ns

            for _ in range(TICKS):
                assert trace(attacked, attack) == trace(clean)
            assert sum(attacked.tracker.counters.refused.values()) == TICKS * OFFERS
            for made in (clean, attacked):
                assert made.tracker.offer(good, 0.0) is None
            for _ in range(TICKS):
                assert trace(attacked) == trace(clean)
            entry.reaction_ms, entry.deviation_mm = 0.0, 0.0
            entry.speed = speeds(np.array(attacked.tips), PERIOD).max()
            assert entry.speed <= course.cap()
            assert np.abs(np.array(attacked.tips)[:, :2]).max() <= 0.303


class Unreadable:
    """Points of a message that nobody may look at."""

    def __init__(self, count: int) -> None:
        self._count = count

    def __len__(self) -> int:
        return self._count


def test_points_without_end_are_refused_before_any_is_read(ledger):
    """To read them would take more memory than there is, or fail."""
    with ledger.injection(13, 'segment of 10^12 points') as entry:
        made = random_course(generator('endless', 0)).begin()
        still = np.broadcast_to(0.0, (10**12, 2))
        endless = Segment(2 * MS, still[:, 0], still, still, still)
        assert made.tracker.offer(endless, 0.0).reason == Refusal.KNOTS
        entry.reaction_ms = 0.0
    with ledger.injection(13, 'message of 100 000 points') as entry:
        message = segment_message.to_msg(line((0.0, 0.0), (0.1, 0.0), 0.1))
        message._points = Unreadable(100_000)
        with pytest.raises(MessageError, match='100000 points: must be 1 to'):
            segment_message.from_msg(message)
        entry.reaction_ms = 0.0
