# SPDX-License-Identifier: Apache-2.0
from itertools import permutations

import numpy as np
import pytest
from synthetic_run import Player, lesson, planner_health, segment

from srnn_msgs_py.health import Health
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import ExecutedPath
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate


def pieces(stamp):
    plan = segment(stamp, (0.0, 0.0), (0.1, 0.0))
    return plan, {
        'executed': ExecutedPath(stamp, plan.times, plan.positions),
        'result': SegmentResult(stamp, ResultCode.DONE),
        'dissonance': lesson(stamp),
    }


@pytest.mark.parametrize('order', list(permutations(['executed', 'result', 'dissonance'])))
def test_a_segment_is_over_when_everything_was_heard_in_any_order(recorder, order):
    plan, parts = pieces(1)
    recorder.segment(plan)
    for count, part in enumerate(order):
        assert len(recorder.records) == 0, order[:count]
        getattr(recorder, part)(parts[part])
    (record,) = recorder.records
    assert (record.number, record.plan, record.lesson) == (1, plan, parts['dissonance'])


def test_an_adapter_that_is_silent_holds_nothing_up_for_long(recorder):
    for stamp in (1, 2, 3):
        plan, parts = pieces(stamp)
        recorder.segment(plan)
        recorder.executed(parts['executed'])
        recorder.result(parts['result'])
    (record,) = recorder.records
    assert record.plan.stamp_ns == 1
    assert record.lesson is None
    assert not record.updated


def test_refused_segments_are_not_numbered(recorder):
    player = Player(recorder)
    player.go((0.0, 0.0))
    recorder.segment(segment(77, (0.0, 0.0), (0.1, 0.0)))
    recorder.result(SegmentResult(77, ResultCode.REJECTED, 'too fast'))
    player.go((0.1, 0.0))
    assert [record.number for record in recorder.records] == [1, 2]
    assert [result.reason for result in recorder.refused] == ['too fast']


def test_what_belongs_to_no_known_segment_is_ignored(recorder):
    _, parts = pieces(9)
    for part, value in parts.items():
        getattr(recorder, part)(value)
    assert not recorder.records


def test_progress_is_that_of_the_executed_path(recorder, configuration):
    player = Player(recorder)
    for point in (*configuration.scene.waypoints, configuration.scene.waypoints[0]):
        player.go(point)
    assert [record.before.active for record in recorder.records] == [0, 1, 2, 3, 0]
    assert all(record.reached for record in recorder.records)
    assert [record.after.laps for record in recorder.records] == [0, 0, 0, 1, 1]
    player.touch(configuration.scene.waypoints[1])
    assert recorder.records[-1].touched
    assert not recorder.records[-1].reached


def test_planning_times_find_their_segment_by_identity(recorder):
    plan, parts = pieces(1)
    recorder.segment(plan)
    recorder.health(planner_health(planned=1, planning_ms=1.5, segment_stamp_ns=1))
    recorder.health(planner_health(planned=2, planning_ms=2.5, segment_stamp_ns=2))
    for part, value in parts.items():
        getattr(recorder, part)(value)
    assert recorder.records[0].planning_ms == 1.5


def test_only_an_active_planner_is_quoted(recorder):
    recorder.health(planner_health(planned='4', deadline_misses='1'))
    recorder.health(planner_health(state='inactive'))
    recorder.health({'/adapter': Health(values={'planned': '9'})})
    assert recorder.figures == {'planned': '4', 'deadline_misses': '1'}


def test_the_largest_force_and_the_last_weights_are_kept(recorder):
    assert recorder.force_peak is None
    for force in (0.0, 12.0, 3.0):
        recorder.force(force)
    nothing = LearnedWeights(2, 0, np.zeros(0, np.int64), np.zeros(0, np.float32))
    for version in (0, 1):
        recorder.weights(WeightsUpdate(version, 0, nothing))
    assert recorder.force_peak == 12.0
    assert recorder.last_weights.version == 1
