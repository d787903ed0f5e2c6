# SPDX-License-Identifier: Apache-2.0
"""Every deed of a planner is noted, before it is done, with what tells it from others."""

import itertools

from lessons import SMALL
import numpy as np
import pytest

from srnn_config.scene import Scene, SceneTask
from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.health import HealthLevel
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import ExecutedPath
from srnn_msgs_py.waypoints import Waypoints
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core.errors import SrnnError
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planner_health import planner_health
from srnn_planner.core.planning_session import Origin, PlanningSession
from srnn_planner.core.statistics import Durations
from srnn_planner.core.synapses import Synapses

SCENE = Scene(SceneTask('free'), waypoints=((0.1, 0.0), (-0.1, 0.0)))
ORIGIN = Origin(SCENE, ModelParameters(network=SMALL), PlanningParameters(), 3)
HERE = np.array([0.0, 0.0, 0.0])


@pytest.fixture
def notes():
    return []


@pytest.fixture
def session(notes):
    return PlanningSession(ORIGIN, lambda *numbers, **times: notes.append((*numbers, times)))


def dead(session):
    synapses = session.planner.synapses
    return Synapses.of(synapses.prior, np.full_like(synapses.dense(), -1.0)).learned


def test_what_is_heard_is_noted_even_if_it_is_refused(session, notes):
    update = WeightsUpdate(4, 0, session.planner.synapses.learned)
    older = WeightsUpdate(3, 0, update.learned)
    ended = SegmentResult(8, ResultCode.DONE)
    session.begin()
    session.blind()
    session.weights(update)
    session.result(ended, 2.5)
    session.lesson(Dissonance(9, 'spatial', False, 4, 0.0, np.zeros(1), np.zeros(1), 1.0))
    session.tour(Waypoints(10, np.array([[0.1, 0.1], [0.0, 0.1]])))
    session.executed(ExecutedPath(11, np.arange(2.0), np.zeros((2, 2))))
    for take, value in (
        (session.executed, ExecutedPath(12, np.arange(2.0), np.full((2, 2), np.nan))),
        (session.weights, older),
        (session.tour, Waypoints(13, np.zeros((0, 2)))),
    ):
        with pytest.raises(SrnnError):
            take(value)
    assert notes == [
        (Deed.ACTIVATED, {}),
        (Deed.BLIND, {}),
        (Deed.WEIGHTS, 4, update.checksum(), {}),
        (Deed.ENDED, 8, ended.digest(), 2.5, {}),
        (Deed.LEARNED, 9, {}),
        (Deed.TOUR, 10, {}),
        (Deed.EXECUTED, 11, {}),
        (Deed.EXECUTED, 12, {}),
        (Deed.WEIGHTS, 3, older.checksum(), {}),
        (Deed.TOUR, 13, {}),
    ]


def test_whether_something_was_due_planned_or_found_impossible_is_noted(session, notes):
    clock = itertools.count(10).__next__
    assert session.plan(5.0, clock) is None
    session.pose(HERE)
    trajectory = session.plan(6.0, clock)
    session.sent(77, trajectory, 6.0, 6.25)
    session.sequencer.forget_motion()
    session.weights(WeightsUpdate(1, 0, dead(session)))
    session.pose(HERE)
    assert session.plan(8.0, clock) is None
    assert [row for row in notes if row[0] is not Deed.WEIGHTS] == [
        (Deed.PLANNED, {'time_s': 5.0}),
        (Deed.PLANNED, 77, {'time_s': 6.0, 'until_s': 6.25}),
        (Deed.PLANNED_IN_VAIN, {'time_s': 8.0, 'until_s': 10}),
    ]
    counters = session.sequencer.counters
    assert (counters.planned, counters.invalid_plans) == (1, 1)


def test_the_way_points_of_now_are_told_in_metres(session):
    np.testing.assert_allclose(session.waypoints(5).points, SCENE.waypoints)
    session.tour(Waypoints(1, np.array([[0.0, 0.2], [0.2, 0.0]])))
    tour = session.waypoints(6)
    assert tour.stamp_ns == 6
    np.testing.assert_allclose(tour.points, [[0.0, 0.2], [0.2, 0.0]])


def test_doubts_are_warnings_dead_weights_an_error_that_comes_first(session):
    times = Durations()
    times.record(0.25)
    health = planner_health(session, times, 9, '')
    assert (health.level, health.message) == (HealthLevel.OK, '')
    assert health.values['planning_ms'] == health.values['planning_ms_p99'] == 250.0
    assert (health.values['segment_stamp_ns'], health.values['planned']) == (9, 0)
    health = planner_health(session, times, 9, 'no pose')
    assert (health.level, health.message) == (HealthLevel.WARN, 'no pose')
    session.weights(WeightsUpdate(1, 0, dead(session)))
    session.pose(HERE)
    for now in range(ORIGIN.planning.dead_after):
        session.plan(float(now), lambda: 0.0)
    health = planner_health(session, times, 9, 'no pose')
    assert health.level is HealthLevel.ERROR
    assert health.message == session.watched.watch.trouble != ''
