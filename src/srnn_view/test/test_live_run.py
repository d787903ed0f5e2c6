# SPDX-License-Identifier: Apache-2.0
"""What was heard is kept, once, and not for ever."""

import numpy as np
import pytest

from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_view.events import Event, EventLog, Grave
from srnn_view.live_run import EVENTS, SEGMENTS, TRAIL, LiveRun, Part


@pytest.fixture
def run():
    run = LiveRun()
    assert run.changed() == set(Part)
    return run


def lesson(peak: float, updated: bool) -> Dissonance:
    return Dissonance(1, 'local', updated, 2, peak, np.zeros(3), np.zeros(4), 1.5)


def planner(stamp: int, planned: int) -> dict[str, Health]:
    values = {'segment_stamp_ns': str(stamp), 'planning_ms': '2.5', 'planned': str(planned)}
    return {'/lab/planner': Health(HealthLevel.OK, '', values)}


def test_only_what_has_changed_is_drawn_anew(run):
    assert run.changed() == frozenset()
    run.measured(np.zeros(7))
    run.moved(np.zeros((3, 3)))
    assert run.changed() == {Part.ARM, Part.EXECUTED}
    assert run.changed() == frozenset()


def test_segments_that_were_refused_were_not_executed(run):
    for code in ResultCode:
        run.ended_as(SegmentResult(1, code, 'why'), 0.0)
    assert set(run.counts.values()) == {1}
    assert run.ended == 3
    assert [event.text for event in run.log.events] == [
        'touch: why', 'REJECTED: why', 'STALE: why', 'FAULT: why',
    ]  # fmt: skip


def test_lessons_are_numbered_and_updates_timed(run):
    run.learned(lesson(0.5, False))
    run.learned(lesson(3.0, True))
    assert list(run.lessons) == [(1, 0.5, False), (2, 3.0, True)]
    assert list(run.updates) == [(2, 1.5)]


def test_a_planning_time_that_is_said_again_is_one(run):
    for stamp, planned in ((10, 1), (10, 1), (20, 2)):
        run.felt(planner(stamp, planned), 0.0)
    assert list(run.planning) == [(1, 2.5), (2, 2.5)]
    assert set(run.health) == {'planner'}


def test_what_a_node_says_again_and_again_is_one_event(run):
    worried = {'/tracker': Health(HealthLevel.WARN, 'late')}
    fine = {'/tracker': Health(HealthLevel.OK, 'no matter')}
    for seconds, health in enumerate((worried, worried, fine, fine, worried)):
        run.felt(health, 5.0 + seconds)
    assert [(e.time, e.source, e.text) for e in run.log.events] == [
        (0.0, 'tracker (health)', 'late'), (4.0, 'tracker (health)', 'late'),
    ]  # fmt: skip


def test_two_touches_alike_are_two_events():
    log = EventLog()
    touch = Event(1.0, 'tracker', Grave.WARN, 'touch')
    assert log.add(touch)
    assert log.add(touch)


def test_a_long_run_needs_no_more_memory_than_a_short_one(run):
    for number in range(2 * SEGMENTS):
        run.learned(lesson(1.0, True))
        run.moved(np.zeros((3, 3)))
        run.felt(planner(number, number), 0.0)
        run.ended_as(SegmentResult(number, ResultCode.BLOCKED, 'force'), float(number))
    kept = (run.lessons, run.updates, run.planning, run.executed, run.log.events)
    assert [len(values) for values in kept] == [SEGMENTS, SEGMENTS, SEGMENTS, TRAIL, EVENTS]
    assert run.lessons[-1][0] == 2 * SEGMENTS
    assert run.log.events[-1].time == 2 * SEGMENTS - 1
