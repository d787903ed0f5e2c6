# SPDX-License-Identifier: Apache-2.0
"""The network of three dimensions moves as that of two, and learns of what it touches."""

from pathlib import Path
import sys

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / 'bench'))
from ball_world import random_scene, run
from scale_setting import Case, setting
from three_dimensions import SEGMENTS, learned, movements, with_signal

GIVEN = setting(Case(3, 11))
SCENES = [random_scene(3, GIVEN.model.workspace.half_extent, seed) for seed in range(8)]


def test_activity_neither_dies_nor_explodes_and_heads_for_the_target():
    spikes, valid, pace = np.array(movements(GIVEN, SCENES, seed=5)).T
    spikes /= GIVEN.planning.sampling.samples
    assert valid.min() >= 0.8
    assert valid.mean() >= 0.98
    # Two dimensions: 112 to 126 spikes, 3.6 neurons.
    assert 90.0 < spikes.min() <= spikes.max() < 150.0
    assert pace.min() > 1.0
    assert 2.5 < pace.mean() < 5.0


@pytest.mark.slow
def test_a_ball_is_learned_by_touch():
    trials = [run(GIVEN, scene, SEGMENTS, seed) for seed, scene in enumerate(SCENES)]
    assert sum(map(learned, trials)) >= 6
    assert all(trial.updates for trial in trials if trial.touched)
    unlearned = with_signal(GIVEN, 'none')
    without = [run(unlearned, scene, SEGMENTS, seed) for seed, scene in enumerate(SCENES)]
    assert sum(map(learned, without)) <= 2
