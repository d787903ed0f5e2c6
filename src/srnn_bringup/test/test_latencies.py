# SPDX-License-Identifier: Apache-2.0
"""Of a run whose times are known, these are the times that are found."""

import numpy as np
import pytest
import recorded_touch as run

from lwr_description import Mount
from srnn_bag import open_bag
from srnn_bringup.latency import answers, lessons, touches
from srnn_bringup.latency.planning_share import planning_shares
from srnn_config.scene import Obstacle
from srnn_replay import planner_replay, tracker_replay
from srnn_replay.recording import Recording


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    return open_bag(run.write(tmp_path_factory.mktemp('run') / 'bag'))


@pytest.fixture(scope='module')
def tracker(bag):
    return Recording(bag, tracker_replay.NODE, touches.TOPICS, '/')


@pytest.fixture(scope='module')
def planner(bag):
    return Recording(bag, planner_replay.NODE, lessons.TOPICS, '/')


def test_every_answer_is_counted_from_the_joint_state_that_it_answers(tracker):
    found = answers.answers(tracker)
    assert len(found.times_ms) == run.CYCLES - 1
    assert found.times_ms == pytest.approx(1e-6 * run.ANSWER)
    assert found.unanswered == 1


def test_commands_that_do_not_go_with_the_journal_answer_nothing(tracker):
    (session,) = tracker.sessions
    shorter = type(session)(session.began_ns, session.rows[:-1], session.until_ns)
    assert answers.answered(tracker, shorter) == {}


def test_a_touch_begins_where_the_tip_was_clear_last(tracker):
    (touch,) = touches.TouchFinder(tracker, Mount(), [run.DISC]).touches()
    assert touch.stamp_ns == run.FIRST
    assert touch.clear_ns == run.BEGIN + (run.TOUCHED - 1) * run.CYCLE
    assert touch.shown_ns == run.BEGIN + run.STOPPED * run.CYCLE
    assert touch.stopped_ns == run.STOP_SENT
    assert touch.still_ns == run.BEGIN + run.STOOD * run.CYCLE
    assert touch.speed == pytest.approx(run.SPEED)


def test_without_a_known_obstacle_it_begins_with_the_last_truth_that_was_clear(tracker):
    elsewhere = Obstacle(shape='disc', center=(-0.2, -0.2), radius=0.01)
    (touch,) = touches.TouchFinder(tracker, Mount(), [elsewhere]).touches()
    assert touch.clear_ns == run.BEGIN + (run.TOUCHED - 5) * run.CYCLE


@pytest.mark.parametrize('degrees', [-50, 30])
def test_only_the_way_straight_into_the_surface_is_speed(tracker, degrees):
    inward = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    centre = np.array([run.SURFACE, 0.0]) + (0.1 + Mount().tool_radius) * inward
    wall = Obstacle(
        shape='box', center=tuple(centre), size=(0.2, 0.2), yaw=float(np.radians(degrees))
    )
    (touch,) = touches.TouchFinder(tracker, Mount(), [wall]).touches()
    assert touch.speed == pytest.approx(run.SPEED * inward[0], rel=1e-3)


def test_a_lesson_goes_into_the_first_segment_that_is_planned_with_it(planner):
    (lesson,) = lessons.lessons(planner)
    assert lesson.stamp_ns == run.FIRST
    assert lesson.stopped_ns == run.RESULT_SENT
    assert lesson.shared_ns - lesson.stopped_ns == run.SHARED
    assert lesson.sent_ns - lesson.stopped_ns == run.SENT
    # Steady times are seconds with a resolution of their own.
    assert lesson.begun_ns - lesson.stopped_ns == pytest.approx(run.BEGUN, abs=1000)


def test_planning_is_a_share_of_what_it_plans(planner):
    expected = np.array([0.004, 0.003, 0.006]) / run.DURATION_S
    assert planning_shares(planner) == pytest.approx(expected)
