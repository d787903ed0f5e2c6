# SPDX-License-Identifier: Apache-2.0
"""The whole system on simulated time: it learns, repeats itself, and moves smoothly."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from lwr_tracking.core.parameters import TrackerParameters
from srnn_config.scene import load_scene
from srnn_experiments.agent import Brain
from srnn_experiments.setting import Setting
from srnn_experiments.trial import make_agent, make_run, make_world, run_trial
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

SCENE = load_scene(Path(__file__).parents[3] / 'config/scenes/four_waypoints.yaml')
FREE = replace(SCENE, obstacles=())


def setting(segments, scene=SCENE, signal='local', world='mujoco', agent='network'):
    brain = Brain(ModelParameters(), PlanningParameters())
    return Setting(scene, brain, segments, world, agent).with_signal(signal)


@pytest.mark.parametrize('world', ['mujoco', 'point'])
def test_same_seed_gives_the_same_run_bit_for_bit(world):
    first, second = (run_trial(setting(6, world=world), 5) for _ in range(2))
    for a, b in zip(first.records, second.records, strict=True):
        assert a.plan.stamp_ns == b.plan.stamp_ns
        assert np.array_equal(a.executed.positions, b.executed.positions)
    assert first.synapses.learned.same_as(second.synapses.learned)
    other = run_trial(setting(6, world=world), 6)
    assert not np.array_equal(first.records[0].plan.positions, other.records[0].plan.positions)


def test_segments_join_without_stop_or_jump_in_velocity():
    """No step of the reference's velocity exceeds the acceleration limit times the period."""
    free = setting(8, FREE)
    world = make_world(free, 0)
    run = make_run(free, world, make_agent(free, 0))
    tracking = TrackerParameters()
    velocities = []
    while len(run.records) < 8:
        run.cycle()
        if world.tracker.reference is not None:
            velocities.append(world.tracker.reference.velocity[:2].copy())
    steps = np.linalg.norm(np.diff(velocities, axis=0), axis=1)
    assert steps.max() <= tracking.gate.acceleration_limit * tracking.period
    for before, after in pairwise([record.plan for record in run.records]):
        assert after.positions[0] == pytest.approx(before.positions[-1])
        assert after.velocities[0] == pytest.approx(before.velocities[-1])
        assert np.linalg.norm(after.velocities[0]) > 0.02


def test_free_motion_is_tracked_within_two_millimetres_and_teaches_nothing():
    figures = run_trial(setting(12, FREE), 0).figures
    assert figures['tracking_rmse_m'] < 0.002
    assert figures['updates_triggered'] == figures['contacts'] == 0


def test_a_point_learns_nothing_in_a_world_without_obstacle_over_300_segments():
    figures = run_trial(setting(300, FREE, world='point'), 0).figures
    assert figures['segments_executed'] == 300
    assert figures['updates_triggered'] == figures['contacts'] == 0
    assert figures['invalid_plans'] == 0


@pytest.mark.slow
def test_local_signal_learns_the_obstacle_and_without_learning_contacts_go_on():
    learned = run_trial(setting(120), 3).figures
    ignorant = run_trial(setting(60, signal='none'), 3).figures
    assert 1 <= learned['updates_triggered'] <= 15
    assert learned['contacts_last_third'] <= 1
    assert len(learned['segments_to_blocked']) >= 3
    assert learned['invalid_plans'] == 0
    assert learned['contact_force_peak_n'] < 60.0
    assert ignorant['contacts_last_third'] >= 10
