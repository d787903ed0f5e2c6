# SPDX-License-Identifier: Apache-2.0
"""Robots that imagine with the compiled sampler and with that in NumPy behave alike.

Whole trials on random scenes, the same with either sampler. Random numbers differ, and single
trials are chaotic: what is compared are means over scenes. Differences beyond four standard
errors have a false-alarm rate below 1e-3 for each of three figures.
"""

import numpy as np
import pytest

from srnn_experiments.agent import Brain
from srnn_experiments.random_scene import random_scene
from srnn_experiments.setting import Setting
from srnn_experiments.trial import run_trial
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.sampling import PlainSampler

BRAIN = Brain(ModelParameters(), PlanningParameters())
SEEDS = range(1000, 1010)
SEGMENTS = 120


def figures():
    """Return touches, way points reached and duration of one trial on each scene."""
    found = []
    for seed in SEEDS:
        scene = random_scene(seed)
        outcome = run_trial(Setting(scene, BRAIN, SEGMENTS, 'point'), seed)
        told = outcome.figures
        found.append((told['contacts'], told['waypoints_reached'], told['simulated_s']))
    return np.array(found, dtype=float)


@pytest.mark.slow
def test_trials_with_either_sampler_have_the_same_figures(monkeypatch):
    compiled = figures()
    monkeypatch.setattr('srnn_planner.core.planner.Sampler', PlainSampler)
    plain = figures()
    difference = compiled - plain
    error = difference.std(axis=0, ddof=1) / np.sqrt(len(difference))
    assert (np.abs(difference.mean(axis=0)) <= 4.0 * error + 1e-9).all(), difference
    assert plain[:, 1].min() > 0.0
