# SPDX-License-Identifier: Apache-2.0
"""The arm is stopped halfway once; afterwards the planner goes around that place."""

import numpy as np

from srnn_planner.core.adapter import Learner
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planner import PlanRequest, SegmentPlanner
from srnn_planner.core.retreat import at_rest

PLANS = 20

model = ModelParameters()
planner = SegmentPlanner(model, PlanningParameters(), np.random.default_rng([0, 0]))
learner = Learner(model, np.random.default_rng([0, 1]))
here, target = np.array([-0.12, 0.0]), np.array([0.5, 0.0])  # [m], [units]


def plan() -> np.ndarray:
    """Return a segment (T, d) [m] from here to the target, without memory of those before."""
    request = PlanRequest(here, at_rest(here), target, velocity=0.1, again=True)
    trajectory = planner.plan(request).trajectory
    assert trajectory is not None
    return trajectory.positions


def leading_to(place: np.ndarray) -> int:
    """Count segments that come within 50 mm of a place."""
    return sum(bool((np.linalg.norm(plan() - place, axis=1) < 0.05).any()) for _ in range(PLANS))


mental = plan()
beyond = mental[-1]
stopped = len(mental) * 2 // 3
executed = mental.copy()
executed[stopped:] = mental[stopped]  # the arm holds where it has touched
print(f'planned to {beyond.round(3)} m, stopped at {executed[-1].round(3)} m')
print(f'before: {leading_to(beyond)} of {PLANS} plans lead there')

lesson = learner.learn(mental, executed)
planner.use_weights(learner.synapses.learned)
print(f'learned: {lesson.updated}, largest rate {lesson.peak:.2f}, '
      f'{learner.synapses.learned.values.size} of {model.network.neurons ** 2} synapses')
print(f'after: {leading_to(beyond)} of {PLANS} plans lead there')

# An execution that goes as planned teaches nothing: no weight changes.
print(f'learned from an undisturbed segment: {learner.learn(mental, mental).updated}')
