# SPDX-License-Identifier: Apache-2.0
"""Planning one segment: sample, decode, reject, average, join, give it time."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_config.scene import Obstacle
from srnn_msgs_py.weights import LearnedWeights
from srnn_planner.core.context import ContextPopulation, draw_centres, way_point_population
from srnn_planner.core.decoding import decode, window
from srnn_planner.core.encoding import draw_history, spike_probability
from srnn_planner.core.fatigue import Fatigue
from srnn_planner.core.graze import graze
from srnn_planner.core.grid_mean import GridMean
from srnn_planner.core.known_obstacles import obstacle_input
from srnn_planner.core.longest_step import longest_steps
from srnn_planner.core.parameters import (
    ModelParameters,
    PlanningParameters,
    TrajectoryParameters,
)
from srnn_planner.core.random_words import seeds
from srnn_planner.core.retreat import at_rest, back_off
from srnn_planner.core.sampler import Sampler
from srnn_planner.core.selection import Cost, select
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses
from srnn_planner.core.trajectory import Motion, Trajectory, time_path
from srnn_planner.core.ways import Ways

TARGETS_KEPT = 256
"""Way points whose context neurons are remembered; the oldest are drawn anew."""


@dataclass(frozen=True, eq=False)
class PlanRequest:
    """What the next segment starts from and where it shall go.

    Attributes:
        measured: (d,) where the arm is, or will be when the segment starts [m].
        joining: state of the reference that the segment continues.
        target: (d,) active way point [units].
        velocity: execution speed [m/s].
        retreat_to: (d,) free point [m] to back off to first, from rest; None to go on.
        reach: at this distance from the target it counts as reached [units].
        again: the last plan came to nothing, and the arm has not moved since.

    """

    measured: NDArray[np.float64]
    joining: Motion
    target: NDArray[np.float64]
    velocity: float
    retreat_to: NDArray[np.float64] | None = None
    reach: float = 0.0
    again: bool = False


@dataclass(frozen=True, eq=False)
class Goal:
    """What the network, with its weights of the moment, knows of a way point.

    Attributes:
        context: the population of neurons that pulls there.
        remaining: (K,) length of the way there from each state neuron [units].

    """

    context: ContextPopulation
    remaining: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Plan:
    """The outcome of planning one segment.

    Attributes:
        trajectory: the segment, or None if no valid movement was found.
        samples: (S, T, d) decoded samples [units].
        kept: (S,) which of them were averaged.
        spikes: (T, K) how many of the samples spiked.

    """

    trajectory: Trajectory | None
    samples: NDArray[np.float64]
    kept: NDArray[np.bool_]
    spikes: NDArray[np.uint16]


class SegmentPlanner:
    """Samples segments from the network; holds its weights between segments.

    Attributes:
        neurons: the state neurons.
        synapses: the weights between them.

    """

    def __init__(
        self,
        model: ModelParameters,
        planning: PlanningParameters,
        rng: np.random.Generator,
        known: Iterable[Obstacle] = (),
    ) -> None:
        """Build neurons, window and prior weights.

        Args:
            model: network and learning.
            planning: how to plan.
            rng: source of randomness.
            known: obstacles that need not be learned.

        """
        self.model = model
        self.planning = planning
        self.neurons = StateNeurons(model.network)
        self._mean = GridMean(model.network)
        self.synapses = Synapses(self.neurons.prior)
        self._rng = rng.spawn(1)[0]
        self._window = window(
            planning.sampling.steps, model.network.tau, planning.sampling.decode_sigma
        )
        positions = model.workspace.to_metres(self.neurons.positions)
        bias = obstacle_input(positions, known, planning.obstacles)
        self._sampler = Sampler(self.neurons, bias, planning.context.amplitude)
        self._ways = Ways(self.neurons, bias)
        self._believe()
        self._fatigue = Fatigue(model.network.neurons)
        self._centres: dict[bytes, NDArray[np.float64]] = {}

    def warm_up(self) -> None:
        """Compile every kernel without touching the stream of random numbers."""
        kept, self._rng = self._rng, np.random.default_rng(0)
        rest = Motion(np.zeros(self._dimensions), np.zeros(self._dimensions))
        self.plan(PlanRequest(rest.position, rest, np.full(self._dimensions, 0.5), 0.1))
        self._centres.clear()
        self._fatigue = Fatigue(self.model.network.neurons)
        self._rng = kept

    def use_weights(self, learned: LearnedWeights) -> None:
        """Take new weights for the next segment, all or nothing.

        Raises:
            WeightsError: the weights do not fit; the old ones stay.

        """
        self.synapses = self.neurons.synapses(learned)
        self._believe()

    def plan(self, request: PlanRequest) -> Plan:
        """Plan one segment."""
        origin = request.measured if request.retreat_to is None else request.retreat_to
        position = self.model.workspace.to_units(origin)
        here = self.neurons.responsibilities(position[None])[0]
        if request.retreat_to is None and not request.again:
            # After a contact it is learning that shows the way out.
            self._fatigue.visit(here, request.target)
        goal = self._goal(request.target)
        paths, valid, spikes = self._sample(here, goal.context)
        kept = np.zeros(len(paths), dtype=bool)
        which = np.flatnonzero(valid)
        if len(which) / len(paths) < self.planning.sampling.valid_share:
            return Plan(None, paths, kept, spikes)
        chosen = paths if len(which) == len(paths) else paths[which]
        kept[which] = select(chosen, self.planning.selection, self._cost(request, goal))
        average = self.model.workspace.to_metres(paths[kept].mean(axis=0))
        extent = self.model.workspace.half_extent
        trajectory = segment_along(average, request, self.planning.trajectory, extent)
        return Plan(trajectory, paths, kept, spikes)

    def _sample(
        self, here: NDArray[np.float64], context: ContextPopulation
    ) -> tuple[NDArray[np.float64], NDArray[np.bool_], NDArray[np.uint16]]:
        """Run the network from where neurons are responsible (K,).

        Returns:
            Decoded paths (S, T, d), which of them are valid (S,), and spikes (T, K).

        """
        sampling = self.planning.sampling
        history = draw_history(
            spike_probability(here, self.model.learning), sampling.samples,
            self.model.network.tau, self._rng,
        )  # fmt: skip
        spikes, activity = self._sampler.sample(
            context, history, seeds(self._rng, sampling.samples)
        )
        paths, valid = decode(activity, self._window)
        return paths, valid & (longest_steps(paths) <= sampling.step_max), spikes

    def _believe(self) -> None:
        """Run with the weights, and find out what they say of where the arm can go."""
        self._sampler.use_weights(self.synapses)
        self._blockage = self._ways.blockage.of(self.synapses)
        self._tolls = self._ways.tolls(
            self.synapses, self._blockage, self.planning.context.aversion
        )

    @property
    def _dimensions(self) -> int:
        return self.model.network.dimensions

    def _cost(self, request: PlanRequest, goal: Goal) -> Cost:
        planning = self.planning

        def way_left(paths: NDArray[np.float64]) -> NDArray[np.float64]:
            ends = np.ascontiguousarray(paths[:, -1])
            left = self._mean.at(goal.remaining, ends)
            away = np.sqrt(((ends - request.target) ** 2).sum(axis=1))
            left[away <= request.reach] = 0.0
            return left

        def avoided(paths: NDArray[np.float64]) -> NDArray[np.float64]:
            met = graze(paths, self._mean, self._blockage, planning.selection.caution)
            return planning.context.aversion * met

        return Cost(way_left, avoided)

    def _goal(self, target: NDArray[np.float64]) -> Goal:
        key = target.tobytes()
        parameters = self.planning.context
        if key not in self._centres:
            if len(self._centres) >= TARGETS_KEPT:
                del self._centres[next(iter(self._centres))]
            self._centres[key] = draw_centres(target, parameters, self._rng)
        fatigue = parameters.fatigue * self._fatigue.visits
        remaining = self._ways.remaining(self._tolls, target, fatigue)
        context = way_point_population(
            self._centres[key], self.neurons.positions, self.planning.sampling.steps,
            parameters, self._ways.detour(remaining, target),
        )
        return Goal(context, remaining)


def segment_along(
    path: NDArray[np.float64],
    request: PlanRequest,
    parameters: TrajectoryParameters,
    half_extent: float,
) -> Trajectory | None:
    """Return the segment that follows a path (T, d) [m] and joins the motion before it.

    After a contact it begins with the way back. None if it cannot keep the limits of
    acceleration and workspace.
    """
    start = request.joining
    if request.retreat_to is not None:
        start = at_rest(request.retreat_to)
    trajectory = time_path(path, start, request.velocity, parameters)
    if trajectory is not None and request.retreat_to is not None:
        contact = request.joining.position
        trajectory = back_off(contact, trajectory, parameters.acceleration)
    if trajectory is None:
        return None
    extent = half_extent - parameters.edge_margin
    return trajectory if np.abs(trajectory.positions).max() <= extent else None
