# SPDX-License-Identifier: Apache-2.0
"""The network of a configuration file with more or fewer neurons around it."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from srnn_bringup.config_files import NetworkFile
from srnn_config import build, read_yaml
from srnn_planner.core.parameters import ModelParameters, NetworkParameters, PlanningParameters
from srnn_planner.core.planner import PlanRequest
from srnn_planner.core.retreat import at_rest

CONFIG = Path(__file__).parents[1] / 'config'
FILES = {2: 'network.yaml', 3: 'network_3d.yaml'}
"""The network in so many dimensions."""

VELOCITY = 0.1
"""Speed of segments [m/s]."""

STOP = 0.5
"""The execution that is learned from stops after this share of the plan."""

NEAR = 3.5
"""A near target is so many neurons away along each of the first two axes."""

BEGINNING = {2: 7.6, 3: 13.0}
"""Mean number of neurons that are active when a segment begins, by dimensions."""

FINEST = 2.0**-20
"""A weight that differs less from those of distant neurons counts as one of them."""


@dataclass(frozen=True)
class Case:
    """What is measured: a cube of so many neurons a side, samples of a plan, replays."""

    dimensions: int
    side: int
    samples: int = 40
    replays: int = 20

    @property
    def neurons(self) -> int:
        """Number K of state neurons."""
        return int(self.side**self.dimensions)


@dataclass(frozen=True)
class Setting:
    """Parameters of a case, and what is asked of it."""

    model: ModelParameters
    planning: PlanningParameters

    @property
    def spacing(self) -> float:
        """Distance of neighbours on the grid [units]."""
        return 2.0 / (self.model.network.neurons_per_dimension - 1)

    @property
    def here(self) -> NDArray[np.float64]:
        """Where segments begin (d,) [m], two neurons from the centre along two axes."""
        return np.asarray(self.model.workspace.to_metres(self._along(-2.0 * self.spacing)))

    def near(self) -> PlanRequest:
        """Return a request whose target is the same number of neurons away in all cases."""
        return self._request(self._along((NEAR - 2.0) * self.spacing))

    def across(self) -> PlanRequest:
        """Return a request whose target is half-way from the centre to the edge."""
        return self._request(self._along(0.5))

    def touch(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return a plan (T, d) and an execution that stops half-way [m]."""
        first = np.eye(self.model.network.dimensions)[0]
        steps = self.planning.sampling.steps
        plan = np.linspace(self.here - 0.03 * first, self.here + 0.07 * first, steps)
        executed = plan.copy()
        executed[round(STOP * steps) :] = plan[round(STOP * steps)]
        return plan, executed

    def _along(self, length: float) -> NDArray[np.float64]:
        point = np.zeros(self.model.network.dimensions)
        point[:2] = length, -length
        return point

    def _request(self, target: NDArray[np.float64]) -> PlanRequest:
        return PlanRequest(self.here, at_rest(self.here), target, VELOCITY)


def setting(case: Case) -> Setting:
    """Return the network of the configuration in another size.

    Neurons stay as far apart in metres, so that the workspace grows with their number. Every
    length in units of the workspace shrinks as the units grow; what is in metres or steps stays.
    Then the fan-out of a neuron and the bump are the same. What must change is how seldom a
    neuron spikes by chance, since all of them might: see `_quiet`.
    """
    name = FILES[case.dimensions]
    file = build(NetworkFile, read_yaml(CONFIG / name), name)
    model, planning = file.model, file.planning
    s = (model.network.neurons_per_dimension - 1) / (case.side - 1)
    p = planning
    return Setting(
        replace(
            model,
            workspace=replace(model.workspace, half_extent=model.workspace.half_extent / s),
            network=_quiet(
                replace(
                    model.network, neurons_per_dimension=case.side, sigma=s * model.network.sigma
                ),
                case.neurons / model.network.neurons,
            ),
            learning=replace(
                model.learning, horizon=s * model.learning.horizon, replays=case.replays
            ),
        ),
        replace(
            planning,
            context=replace(
                p.context, spread=s * p.context.spread, scale=s * p.context.scale
            ),
            sampling=replace(
                p.sampling, samples=case.samples, step_max=s * p.sampling.step_max
            ),
            selection=replace(p.selection, caution=s * p.selection.caution),
        ),
    )  # fmt: skip


def _quiet(network: NetworkParameters, times: float) -> NetworkParameters:
    """Return a network of so many times the neurons in which no more of them spike by chance.

    While the bump begins, it inhibits all others by the offset of each active neuron alone. A
    steeper activation that reaches its limit at the same input makes them less likely to spike.
    """
    full = (network.threshold + np.log(network.spike_probability_max)) / network.slope
    below = full + BEGINNING[network.dimensions] * network.weight_offset
    steeper = max(float(np.log(times) / below), 0.0)
    return replace(
        network, slope=network.slope + steeper, threshold=network.threshold + steeper * full
    )


def fan_out(network: NetworkParameters) -> int:
    """Return how many synapses of a neuron off the edge differ from those of distant ones."""
    spacing = 2.0 / (network.neurons_per_dimension - 1)
    reach = network.sigma * np.sqrt(2.0 * np.log(network.weight_gain / FINEST)) / spacing
    cells = np.arange(-int(reach), int(reach) + 1) ** 2
    squared = sum(np.ix_(*[cells] * network.dimensions), np.zeros(1))
    return int((squared <= reach**2).sum())
