# SPDX-License-Identifier: Apache-2.0
"""The whole system on simulated time: it learns, repeats itself, and moves smoothly."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from lwr_tracking.core.parameters import TrackerParameters
from srnn_config.scene import load_scene
from srnn_experiments.lockstep import LockStep
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

SCENE = load_scene(Path(__file__).parents[3] / 'config/scenes/four_waypoints.yaml')
MODEL, PLANNING = ModelParameters(), PlanningParameters()


def world(seed=0, scene=SCENE, signal='local'):
    model = replace(MODEL, learning=replace(MODEL.learning, signal=signal))
    return LockStep(scene, seed, model, PLANNING)


def test_same_seed_gives_the_same_run_bit_for_bit():
    first, second = world(5).run(6), world(5).run(6)
    assert [r.stamp_ns for r in first.results] == [r.stamp_ns for r in second.results]
    for stamp, path in first.paths.items():
        assert np.array_equal(path.positions, second.paths[stamp].positions)


def test_segments_join_without_stop_or_jump_in_velocity():
    """No step of the reference's velocity exceeds the acceleration limit times the period."""
    free = world(scene=replace(SCENE, obstacles=()))
    gate = TrackerParameters().gate
    velocities = []
    while len(free.log.results) < 8:
        free.cycle()
        if free.tracker.reference is not None:
            velocities.append(free.tracker.reference.velocity[:2].copy())
    steps = np.linalg.norm(np.diff(velocities, axis=0), axis=1)
    assert steps.max() <= gate.acceleration_limit * gate.period
    segments = [free.log.segments[r.stamp_ns] for r in free.log.results]
    for before, after in pairwise(segments):
        assert after.positions[0] == pytest.approx(before.positions[-1])
        assert after.velocities[0] == pytest.approx(before.velocities[-1])
        assert np.linalg.norm(after.velocities[0]) > 0.02


def test_free_motion_is_tracked_within_two_millimetres_and_teaches_nothing():
    log = world(scene=replace(SCENE, obstacles=())).run(12)
    assert log.rmse() < 0.002
    assert not log.updates
    assert not log.contacts


@pytest.mark.slow
def test_local_signal_learns_the_obstacle_and_without_learning_contacts_go_on():
    with_learning, without = world(3), world(3, signal='none')
    learned, ignorant = with_learning.run(120), without.run(60)
    assert 1 <= len(learned.updates) <= 15
    assert len([n for n in learned.contacts if n >= 80]) <= 1
    assert sum(way_point == 1 for _, way_point in learned.reached) >= 3
    assert with_learning.sequencer.counters.invalid_plans == 0
    assert learned.force_peak < 60.0
    assert len([n for n in ignorant.contacts if n >= 40]) >= 10
