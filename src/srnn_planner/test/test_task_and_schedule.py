# SPDX-License-Identifier: Apache-2.0
"""Way points in turn, and planning as late as possible."""

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_planner.core.errors import SrnnError, TaskError
from srnn_planner.core.parameters import ScheduleParameters
from srnn_planner.core.schedule import PlanningSchedule
from srnn_planner.core.task import WaypointTask

SQUARE = np.array([[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.5, -0.5]])


@given(laps=st.integers(0, 5))
def test_visiting_all_way_points_is_a_lap(laps):
    task = WaypointTask(SQUARE, 0.2)
    for _ in range(laps):
        for point in SQUARE:
            task = task.after(point + 0.1)
    assert task.laps == laps
    assert task.active == 0
    assert task.reached == 4 * laps


def test_way_point_stays_active_until_it_is_reached():
    task = WaypointTask(SQUARE, 0.2)
    assert task.after(SQUARE[1]) is task
    assert task.after(SQUARE[0] + [0.21, 0.0]) is task
    assert task.after(SQUARE[0] + [0.19, 0.0]).active == 1


@pytest.mark.parametrize(
    ('points', 'radius'),
    [(np.zeros((0, 2)), 0.2), (np.array([[2.0, 0.0]]), 0.2), (SQUARE, 0.0),
     (np.array([[np.nan, 0.0]]), 0.2)],
)
def test_impossible_tasks_are_refused(points, radius):
    with pytest.raises(TaskError) as error:
        WaypointTask(points, radius)
    assert isinstance(error.value, SrnnError)


@given(times=st.lists(st.floats(1e-4, 0.5), min_size=2, max_size=40))
def test_lead_is_mean_plus_three_sigma_plus_margin(times):
    parameters = ScheduleParameters()
    schedule = PlanningSchedule(parameters)
    for seconds in times:
        schedule.record(seconds)
    expected = np.mean(times) + 3.0 * np.std(times) + parameters.margin
    assert schedule.lead == pytest.approx(expected)
    assert schedule.start(10.0, 5.0) == pytest.approx(15.0 - expected)


def test_before_any_measurement_the_assumed_time_counts():
    parameters = ScheduleParameters()
    assert PlanningSchedule(parameters).lead == parameters.initial + parameters.margin


def test_planning_never_starts_before_the_segment():
    assert PlanningSchedule(ScheduleParameters()).start(3.0, 0.01) == 3.0


def test_old_planning_times_are_forgotten():
    schedule = PlanningSchedule(ScheduleParameters(window=5))
    for seconds in (0.4, 0.4, *[0.01] * 5):
        schedule.record(seconds)
    assert schedule.lead == pytest.approx(0.01 + ScheduleParameters().margin)
