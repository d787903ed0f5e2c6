# SPDX-License-Identifier: Apache-2.0
"""Segments that touch something, and a small network that learns from them at once."""

from dataclasses import replace

import numpy as np

from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_planner.core.adapter import Learner
from srnn_planner.core.learned_model import LearnedModel
from srnn_planner.core.parameters import LearningParameters, ModelParameters, NetworkParameters

SMALL = NetworkParameters(neurons_per_dimension=5, sigma=0.3)
MODEL = ModelParameters(network=SMALL, learning=replace(LearningParameters(), replays=2))


def learned_model(seed=1, model=MODEL, initial=None):
    learner = Learner(model, np.random.default_rng([seed, 1]))
    learner.warm_up()
    return LearnedModel(learner, initial)


def pair(stamp_ns, steps=30):
    """Return a plan and its execution, which ends in a contact somewhere; the stamp decides."""
    rng = np.random.default_rng(stamp_ns)
    start, direction = rng.uniform(-0.1, 0.1, 2), rng.standard_normal(2)
    direction *= 0.12 / np.linalg.norm(direction)
    plan = start + np.linspace(0.0, 1.0, steps)[:, None] * direction
    stop = int(rng.integers(5, steps // 2))
    executed = plan.copy()
    executed[stop:] = plan[stop]
    times, none = np.linspace(0.0, 1.0, steps), np.zeros_like(plan)
    return Segment(stamp_ns, times, plan, none, none), ExecutedPath(stamp_ns, times, executed)
