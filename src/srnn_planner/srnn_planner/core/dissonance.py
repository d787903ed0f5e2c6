# SPDX-License-Identifier: Apache-2.0
"""Cognitive dissonance: how far the executed path is from the imagined one."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.encoding import spike_probability
from srnn_planner.core.grid import Indices
from srnn_planner.core.parameters import LearningParameters, ModelParameters
from srnn_planner.core.state_neurons import StateNeurons


@dataclass(frozen=True, eq=False)
class Mismatch:
    """Plan and execution of one segment, side by side.

    Attributes:
        squared_distance: (T,) |kappa_m - kappa_e|^2 [units^2], eq. 5.
        neurons: (n,) those whose responsibilities count anywhere on the two paths.
        mental: (T, n) their responsibilities for the plan.
        executed: (T, n) their responsibilities for the executed path.

    """

    squared_distance: NDArray[np.float64]
    neurons: Indices
    mental: NDArray[np.float64]
    executed: NDArray[np.float64]


def compare(
    neurons: StateNeurons,
    mental: NDArray[np.float64],
    executed: NDArray[np.float64],
    among: Indices | None = None,
) -> Mismatch:
    """Compare two paths (T, d) in units step by step, `among` some neurons or all."""
    among = np.arange(len(neurons.positions)) if among is None else among
    return Mismatch(
        squared_distance=np.asarray(((mental - executed) ** 2).sum(axis=1)),
        neurons=among,
        mental=neurons.responsibilities(mental, among),
        executed=neurons.responsibilities(executed, among),
    )


def within_horizon(
    mental: NDArray[np.float64], executed: NDArray[np.float64], horizon: float
) -> NDArray[np.float64]:
    """Return the plan, held from where it is farther than `horizon` from the execution.

    The arm that was stopped has learned that it cannot go on from there, and nothing of
    the places beyond, where it has never been. All in units, paths (T, d).
    """
    far = np.linalg.norm(mental - executed, axis=1) > horizon
    if not far.any():
        return mental
    last = max(int(np.argmax(far)) - 1, 0)
    held = mental.copy()
    held[last:] = mental[last]
    return held


def experienced(
    model: ModelParameters,
    neurons: StateNeurons,
    mental: NDArray[np.float64],
    executed: NDArray[np.float64],
) -> Mismatch:
    """Compare a plan with its execution, (T, d) [m], as the model learns from them.

    Neurons that cannot spike learn nothing, and are left out.
    """
    happened = model.workspace.to_units(executed)
    imagined = within_horizon(
        model.workspace.to_units(mental), happened, model.learning.horizon
    )
    highest = neurons.highest_responsibilities(np.concatenate([imagined, happened]))
    may_spike = np.flatnonzero(spike_probability(highest, model.learning))
    return compare(neurons, imagined, happened, may_spike)


def local_signal(mismatch: Mismatch, scale: float) -> NDArray[np.float64]:
    """Return c (omega_m - omega_e)^2 (T, n), before threshold and limit (eq. 6)."""
    return np.asarray(scale * (mismatch.mental - mismatch.executed) ** 2)


class AbstractSignal(ABC):
    """Turns a mismatch into the learning rates of one segment."""

    def __init__(self, parameters: LearningParameters) -> None:
        """Keep thresholds, limit and scales."""
        self._p = parameters

    @abstractmethod
    def rates(self, mismatch: Mismatch) -> NDArray[np.float64]:
        """Return alpha (T, n), zero where nothing is to be learned."""

    def _global(self, mismatch: Mismatch) -> NDArray[np.float64]:
        return _above(mismatch.squared_distance, self._p.global_threshold, self._p.limit)


class NoSignal(AbstractSignal):
    """Never learns: the model without adaptation."""

    def rates(self, mismatch: Mismatch) -> NDArray[np.float64]:
        """Return zeros (T, n)."""
        return np.zeros_like(mismatch.mental)


class GlobalSignal(AbstractSignal):
    """alpha_t = |kappa_m - kappa_e|^2, the same for all neurons (eq. 5)."""

    def rates(self, mismatch: Mismatch) -> NDArray[np.float64]:
        """Return alpha (T, n) with equal columns."""
        return _every_neuron(self._global(mismatch), mismatch)


class LocalSignal(AbstractSignal):
    """alpha_ti = c (omega_m - omega_e)^2, one for each neuron (eq. 6)."""

    def rates(self, mismatch: Mismatch) -> NDArray[np.float64]:
        """Return alpha (T, n)."""
        signal = local_signal(mismatch, self._p.local_scale)
        return _above(signal, self._p.local_threshold, self._p.limit)


class ConstantSignal(AbstractSignal):
    """A constant rate wherever the global signal triggers."""

    def rates(self, mismatch: Mismatch) -> NDArray[np.float64]:
        """Return alpha (T, n): the rate or zero."""
        alpha = np.where(self._global(mismatch) > 0.0, self._p.rate, 0.0)
        return _every_neuron(alpha, mismatch)


class UntriggeredSignal(AbstractSignal):
    """A constant rate in every step of every segment."""

    def rates(self, mismatch: Mismatch) -> NDArray[np.float64]:
        """Return alpha (T, n), the rate everywhere."""
        return np.full_like(mismatch.mental, self._p.rate)


SIGNALS: dict[str, type[AbstractSignal]] = {
    'none': NoSignal,
    'global': GlobalSignal,
    'local': LocalSignal,
    'constant': ConstantSignal,
    'untriggered': UntriggeredSignal,
}


def learning_signal(parameters: LearningParameters) -> AbstractSignal:
    """Return the learning signal that the parameters name."""
    return SIGNALS[parameters.signal](parameters)


def _above(
    signal: NDArray[np.float64], threshold: float, limit: float
) -> NDArray[np.float64]:
    return np.asarray(np.where(signal > threshold, np.minimum(signal, limit), 0.0))


def _every_neuron(alpha: NDArray[np.float64], mismatch: Mismatch) -> NDArray[np.float64]:
    return np.broadcast_to(alpha[:, None], mismatch.mental.shape).copy()
