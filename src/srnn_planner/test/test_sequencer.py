# SPDX-License-Identifier: Apache-2.0
"""When the next segment is planned and from where, event by event."""

import numpy as np
import pytest

from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_planner.core.parameters import PlanningParameters
from srnn_planner.core.sequencer import (
    LOST_AFTER,
    RETREATS,
    RETRY,
    Sequencer,
)
from srnn_planner.core.task import WaypointTask
from srnn_planner.core.trajectory import Motion, time_path
from srnn_planner.core.workspace import Workspace

PLANNING = PlanningParameters()
HERE = np.array([0.0, 0.0])
TOUR = np.array([[0.5, 0.0], [-0.5, 0.0]])


def straight(start=HERE, length=0.1, velocity=(0.0, 0.0)):
    path = np.linspace(start, start + np.array([length, 0.0]), 30)
    return time_path(path, Motion(start, np.array(velocity)), 0.1, PLANNING.trajectory)


@pytest.fixture
def sequencer():
    task = WaypointTask(TOUR, 0.2)
    value = Sequencer(task, Workspace(), PLANNING, 0.1)
    value.tip(HERE)
    return value


def result(stamp, code, **values):
    return SegmentResult(stamp, code, '', values)


def test_nothing_is_due_before_the_arm_is_seen():
    blind = Sequencer(WaypointTask(TOUR, 0.2), Workspace(), PLANNING, 0.1)
    assert blind.wake_time() is None
    assert blind.request(5.0) is None


def test_at_rest_a_plan_is_due_at_once_from_the_measured_tip(sequencer):
    request = sequencer.request(0.0)
    assert request.measured is HERE
    assert not request.joining.velocity.any()
    assert request.target == pytest.approx(TOUR[0])


def test_running_segment_is_followed_as_late_as_planning_allows(sequencer):
    first = straight()
    sequencer.sent(1, first, 0.01, now=10.0)
    due = sequencer.wake_time()
    assert due == pytest.approx(10.0 + first.duration - sequencer.schedule.lead)
    assert sequencer.request(due - 0.001) is None
    request = sequencer.request(due)
    assert request.joining.position == pytest.approx(first.end.position)
    assert request.joining.velocity == pytest.approx(first.end.velocity)


def test_measured_deviation_moves_the_start_of_sampling(sequencer):
    first = straight()
    sequencer.sent(1, first, 0.01, now=0.0)
    due = sequencer.wake_time()
    reference = [np.interp(due, first.times, c) for c in first.positions.T]
    sequencer.tip(np.add(reference, [0.0, 0.004]))
    request = sequencer.request(due)
    assert request.measured == pytest.approx(np.add(first.end.position, [0.0, 0.004]))


def test_one_segment_waits_at_most_and_starts_when_the_running_one_ends(sequencer):
    first = straight()
    sequencer.sent(1, first, 0.01, now=0.0)
    second = straight(first.end.position, 0.1, first.end.velocity)
    sequencer.sent(2, second, 0.01, now=0.9)
    assert sequencer.request(1.0) is None
    sequencer.result(result(1, ResultCode.DONE), now=1.1)
    due = sequencer.wake_time()
    assert due == pytest.approx(1.1 + second.duration - sequencer.schedule.lead)
    assert sequencer.counters.deadline_misses == 0


def test_segment_without_successor_is_a_miss_and_planning_goes_on_from_rest(sequencer):
    sequencer.sent(1, straight(), 0.01, now=0.0)
    sequencer.result(result(1, ResultCode.DONE), now=1.2)
    assert sequencer.counters.deadline_misses == 1
    assert not sequencer.request(1.2).joining.velocity.any()


def test_after_a_contact_the_adapter_and_the_path_are_awaited(sequencer):
    first = straight()
    sequencer.sent(1, first, 0.01, now=0.0)
    sequencer.result(result(1, ResultCode.BLOCKED, force_n=12.0), now=0.5)
    assert sequencer.request(0.55) is None
    sequencer.executed(1, first.positions[:15])
    assert sequencer.request(0.6) is None
    sequencer.learned(1)
    sequencer.tip(first.positions[14])
    request = sequencer.request(0.61)
    moved = np.linalg.norm(request.retreat_to - first.positions[14])
    assert moved >= PLANNING.trajectory.retreat
    assert sequencer.counters.contacts == 1


def test_dead_adapter_delays_planning_only_by_the_bounded_wait(sequencer):
    sequencer.sent(1, straight(), 0.01, now=0.0)
    sequencer.executed(1, straight().positions)
    sequencer.result(result(1, ResultCode.BLOCKED), now=0.5)
    wait = PLANNING.schedule.learning_wait
    assert sequencer.request(0.5 + 0.9 * wait) is None
    assert sequencer.request(0.5 + 1.1 * wait) is not None


def test_a_contact_whose_path_was_never_heard_is_planned_away_from_where_the_arm_is(sequencer):
    sequencer.sent(1, straight(), 0.01, now=0.0)
    sequencer.result(result(1, ResultCode.BLOCKED), now=0.5)
    request = sequencer.request(0.5 + 1.1 * PLANNING.schedule.learning_wait)
    assert request.retreat_to is None


def touch(sequencer, stamp, path, now):
    """Let a segment end in a contact; return how far the next one goes back [m]."""
    sequencer.sent(stamp, straight(), 0.01, now)
    sequencer.executed(stamp, path)
    sequencer.tip(path[-1])
    sequencer.result(result(stamp, ResultCode.BLOCKED), now)
    sequencer.learned(stamp)
    return np.linalg.norm(sequencer.request(now).retreat_to - path[-1])


def test_every_contact_in_a_row_sends_the_arm_farther_back_then_anew(sequencer):
    came = np.linspace(HERE, [0.2, 0.0], 200)
    stuck = np.repeat([[0.2, 0.0]], 5, axis=0)
    retreat = PLANNING.trajectory.retreat
    for number in range(1, 2 * RETREATS):
        back = touch(sequencer, number, came if number == 1 else stuck, float(number))
        times = (number - 1) % RETREATS + 1
        assert back == pytest.approx(times * retreat, abs=0.0011)
    sequencer.sent(90, straight(), 0.01, 50.0)
    sequencer.executed(90, came)
    sequencer.result(result(90, ResultCode.DONE), 51.0)
    assert touch(sequencer, 91, came, 52.0) == pytest.approx(retreat, abs=0.0011)


def test_contact_drops_the_segment_that_was_waiting(sequencer):
    first = straight()
    sequencer.sent(1, first, 0.01, now=0.0)
    sequencer.sent(2, straight(first.end.position, 0.1, first.end.velocity), 0.01, now=0.9)
    sequencer.executed(1, first.positions)
    sequencer.result(result(1, ResultCode.BLOCKED), now=0.95)
    sequencer.result(result(2, ResultCode.REJECTED), now=0.95)
    sequencer.learned(1)
    assert sequencer.request(1.0).retreat_to is not None


def test_refused_successor_is_replanned_from_rest_after_the_running_one(sequencer):
    first = straight()
    sequencer.sent(1, first, 0.01, now=0.0)
    sequencer.sent(2, first, 0.01, now=0.9)
    sequencer.result(result(2, ResultCode.REJECTED), now=0.95)
    assert sequencer.wake_time() == pytest.approx(first.duration + RETRY)
    assert sequencer.counters.rejected == 1


def test_refused_first_segment_is_tried_again_soon(sequencer):
    sequencer.sent(1, straight(), 0.01, now=0.0)
    sequencer.result(result(1, ResultCode.REJECTED), now=0.01)
    assert sequencer.request(0.02) is None
    assert sequencer.request(0.02 + RETRY) is not None


def test_planner_that_is_refused_again_and_again_asks_less_and_less_often(sequencer):
    now, pauses = 0.0, []
    for stamp in range(1, 9):
        sequencer.sent(stamp, straight(), 0.01, now)
        sequencer.result(result(stamp, ResultCode.REJECTED), now)
        pauses.append(sequencer.wake_time() - now)
        now = sequencer.wake_time()
    assert pauses == pytest.approx(RETRY * 2.0 ** np.minimum(np.arange(8), 4))
    sequencer.sent(9, straight(), 0.01, now)
    sequencer.result(result(9, ResultCode.DONE), now)
    sequencer.sent(10, straight(), 0.01, now)
    sequencer.result(result(10, ResultCode.REJECTED), now)
    assert sequencer.wake_time() - now == pytest.approx(RETRY)


def test_a_plan_that_came_to_nothing_is_made_again_until_a_segment_is_executed(sequencer):
    assert not sequencer.request(0.0).again
    sequencer.failed(0.01, now=0.0)
    assert sequencer.request(1.0).again
    sequencer.sent(1, straight(), 0.01, now=1.0)
    sequencer.result(result(1, ResultCode.REJECTED), now=1.0)
    assert sequencer.request(2.0).again
    sequencer.sent(2, straight(), 0.01, now=2.0)
    assert sequencer.request(60.0).again
    sequencer.sent(3, straight(), 0.01, now=60.0)
    sequencer.executed(3, straight().positions)
    sequencer.result(result(3, ResultCode.DONE), now=61.0)
    assert not sequencer.request(61.0).again


def test_results_of_another_planner_are_ignored(sequencer):
    sequencer.sent(7, straight(), 0.01, now=0.0)
    sequencer.result(result(3, ResultCode.BLOCKED), now=0.1)
    assert sequencer.counters.contacts == 0


def test_segment_without_any_result_counts_as_lost(sequencer):
    first = straight()
    sequencer.sent(1, first, 0.01, now=0.0)
    sequencer.sent(2, straight(first.end.position, 0.1, first.end.velocity), 0.01, now=0.9)
    later = first.duration + LOST_AFTER + 0.01
    assert sequencer.wake_time() == pytest.approx(first.duration + LOST_AFTER)
    assert sequencer.request(later) is not None
    assert sequencer.counters.lost == 1


def test_invalid_plan_is_counted_and_tried_again(sequencer):
    sequencer.request(0.0)
    sequencer.failed(0.01, now=0.0)
    assert sequencer.counters.invalid_plans == 1
    assert sequencer.request(RETRY) is not None


def test_reaching_a_way_point_turns_to_the_next(sequencer):
    assert sequencer.executed(1, np.array([[0.0, 0.0], [0.13, 0.0]]))
    assert sequencer.request(0.0).target == pytest.approx(TOUR[1])


def test_next_target_is_planned_for_when_this_segment_will_reach_the_first(sequencer):
    sequencer.sent(1, straight(length=0.14), 0.01, now=0.0)
    request = sequencer.request(sequencer.wake_time())
    assert request.target == pytest.approx(TOUR[1])
    assert sequencer.task.active == 0


def test_forgetting_the_motion_keeps_the_task(sequencer):
    sequencer.executed(1, np.array([[0.13, 0.0]]))
    sequencer.sent(2, straight(), 0.01, now=0.0)
    sequencer.forget_motion()
    sequencer.tip(HERE)
    assert sequencer.task.active == 1
    assert not sequencer.request(0.0).joining.velocity.any()
