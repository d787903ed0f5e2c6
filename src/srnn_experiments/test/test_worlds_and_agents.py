# SPDX-License-Identifier: Apache-2.0
"""The point world, the grid planner and the oracle."""

from dataclasses import replace

import numpy as np
import pytest

from lwr_description import ArmDescription, Mount
from srnn_config.geometry import clearance
from srnn_config.scene import Obstacle, Scene, SceneTask
from srnn_experiments.agent import Brain
from srnn_experiments.grid import SIDE, cell_of, centres, route
from srnn_experiments.grid_agent import beginning
from srnn_experiments.setting import Setting
from srnn_experiments.trial import run_trial
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

BRAIN = Brain(ModelParameters(), PlanningParameters())
POINTS = ((-0.15, -0.1), (0.15, -0.1), (0.15, 0.15), (-0.15, 0.15))
DISC = Obstacle('disc', (0.0, -0.1), radius=0.03)


def setting(segments, *obstacles, **changes):
    scene = Scene(SceneTask(name='here', blocked=1), POINTS, obstacles, start=POINTS[0])
    return Setting(scene, BRAIN, segments, 'point', **changes)


def positions(outcome):
    return np.vstack([record.executed.positions for record in outcome.records])


def test_a_point_never_enters_an_obstacle():
    outcome = run_trial(setting(40, DISC).with_signal('none'), 0)
    assert outcome.figures['contacts'] >= 5
    assert clearance(positions(outcome), [DISC]).min() >= 0.008 - 1e-9


def test_a_point_follows_free_segments_within_a_millimetre():
    figures = run_trial(setting(20), 0).figures
    assert figures['contacts'] == 0
    assert 0.0001 < figures['tracking_rmse_m'] < 0.001


def test_an_obstacle_appears_and_disappears_with_its_segments():
    passing = replace(DISC, appears_at=15, disappears_at=30)
    outcome = run_trial(setting(60, passing).with_signal('none'), 1)
    touched = outcome.figures['contact_segments']
    assert touched
    assert min(touched) > 15
    assert max(touched) <= 31


def test_astar_learns_by_contact_and_then_never_touches_again():
    figures = run_trial(setting(60, DISC, agent='grid'), 0).figures
    assert 1 <= figures['contacts'] <= 6
    assert figures['contacts_last_third'] == 0
    assert figures['laps'] >= 3


def test_the_oracle_goes_round_what_it_was_told_of():
    outcome = run_trial(setting(40, DISC, agent='oracle').with_signal('none'), 0)
    assert outcome.figures['contacts'] <= 1
    assert outcome.figures['laps'] >= 1


def test_settings_differ_in_their_digest_when_anything_differs():
    base = setting(40, DISC)
    others = [
        setting(41, DISC), setting(40), setting(40, DISC, agent='grid'),
        base.with_signal('global'), replace(base, weights=np.zeros((225, 225), np.float32)),
    ]  # fmt: skip
    digests = {s.digest() for s in [base, *others]}
    assert len(digests) == 6
    assert setting(40, DISC).digest() == base.digest()


def test_a_model_of_an_own_arm_that_was_edited_is_another_setting(tmp_path):
    model = tmp_path / 'own.xml'
    model.write_text('<mujoco/>')
    point = setting(40, mount=Mount(description=ArmDescription(model=str(model))))
    arm = replace(point, world='mujoco')
    assert (arm.place, point.place) == (f'world mujoco, arm {model}', 'world point')
    before = arm.digest(), point.digest()
    assert arm.digest() == before[0]
    model.write_text('<mujoco><!-- heavier --></mujoco>')
    assert arm.digest() != before[0]
    assert point.digest() == before[1]


def test_a_route_is_a_straight_line_where_nothing_stands():
    free = np.ones((SIDE, SIDE), dtype=bool)
    way = route(free, np.array([-0.1, 0.05]), np.array([0.2, 0.05]))
    assert np.linalg.norm(np.diff(way, axis=0), axis=1).sum() == pytest.approx(0.3)


def test_a_route_goes_through_free_cells_only_and_there_may_be_none():
    free = (clearance(centres(), [DISC]) > 0.02).reshape(SIDE, SIDE)
    way = route(free, np.array([-0.1, -0.1]), np.array([0.1, -0.1]))
    assert all(free[cell_of(point)] for point in way)
    assert clearance(way, [DISC]).min() > 0.01
    free[30] = False
    assert route(free, np.array([-0.1, -0.1]), np.array([0.1, -0.1])) is None
    assert route(free, np.array([-0.1, -0.1]), np.array([0.1, -0.1]), toll=10.0) is not None


def test_the_beginning_of_a_way_has_its_length_and_even_steps():
    way = np.array([[0.0, 0.0], [0.1, 0.0], [0.1, 0.1]])
    points = beginning(way, 0.15, 31)
    assert points[-1] == pytest.approx([0.1, 0.05])
    assert np.linalg.norm(np.diff(points, axis=0), axis=1) == pytest.approx(0.005)
    assert beginning(way, 1.0, 5)[-1] == pytest.approx([0.1, 0.1])
