# SPDX-License-Identifier: Apache-2.0
"""What plans and learns: the network of the paper, behind a face that others can wear."""

from dataclasses import dataclass
from time import perf_counter
from typing import Protocol

import numpy as np

from srnn_config.scene import Obstacle
from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.weights import LearnedWeights
from srnn_planner.core.adapter import Learner
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planner import PlanRequest, SegmentPlanner
from srnn_planner.core.trajectory import Trajectory


class Agent(Protocol):
    """Plans segments, and learns from how they went."""

    def plan(self, request: PlanRequest) -> Trajectory | None:
        """Return the next segment, None if there is no valid one."""

    def learn(self, plan: Segment, executed: ExecutedPath, touched: bool) -> Dissonance | None:
        """Learn from a segment and its execution; return what was made of it, if anything."""


@dataclass(frozen=True)
class Brain:
    """What the network is and how it plans.

    Attributes:
        model: network and learning.
        planning: what only the planner needs.

    """

    model: ModelParameters
    planning: PlanningParameters


class NetworkAgent:
    """Planner and adapter of the live graph, side by side.

    Attributes:
        planner: samples segments.
        learner: holds the weights.

    """

    def __init__(
        self,
        brain: Brain,
        seed: int,
        known: tuple[Obstacle, ...] = (),
        weights: LearnedWeights | None = None,
    ) -> None:
        """Draw from the random numbers that planner and adapter of the live graph have.

        Args:
            brain: parameters.
            seed: seed of the run.
            known: obstacles that the planner is told of.
            weights: what was learned before; None for nothing.

        """
        self.planner = SegmentPlanner(
            brain.model, brain.planning, np.random.default_rng([seed, 0]), known
        )
        self.learner = Learner(brain.model, np.random.default_rng([seed, 1]))
        self.planner.warm_up()
        self.learner.warm_up()
        if weights is not None:
            self.planner.use_weights(weights)
            self.learner.use_weights(weights)

    def plan(self, request: PlanRequest) -> Trajectory | None:
        """Return the next segment, None if there is no valid one."""
        return self.planner.plan(request).trajectory

    def learn(self, plan: Segment, executed: ExecutedPath, touched: bool) -> Dissonance | None:
        """Learn from a segment and its execution."""
        began = perf_counter()
        lesson = self.learner.learn(plan.positions, executed.positions)
        update_ms = 1e3 * (perf_counter() - began)
        if lesson.updated:
            self.planner.use_weights(self.learner.synapses.learned)
        return lesson.told(plan.stamp_ns, self.learner.signal, self.learner.updates, update_ms)
