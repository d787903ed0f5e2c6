# SPDX-License-Identifier: Apache-2.0
"""Spiking contrastive divergence with mental replay: the plain NumPy reference."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.encoding import postsynaptic_potential


@dataclass(frozen=True, eq=False)
class Experience:
    """One segment, ready to be learned, for the n neurons that may spike in it.

    Attributes:
        neurons: (n,) which neurons; synapses of all others stay as they are.
        executed: (T, n) spike probabilities of the executed path (data).
        mental: (T, n) spike probabilities of the plan (model).
        rates: (T, n) learning signal alpha_ti.

    """

    neurons: NDArray[np.intp]
    executed: NDArray[np.float64]
    mental: NDArray[np.float64]
    rates: NDArray[np.float64]


def contrast(
    weights: NDArray[np.float64],
    executed: NDArray[np.bool_],
    mental: NDArray[np.bool_],
    rates: NDArray[np.float64],
    tau: int,
) -> NDArray[np.float64]:
    """Apply one pair of spike trains (T, n) and return the new weights (n, n).

    w_ki += alpha_ti v~e_k (ve_ti - vm_ti) for every step t (eq. 6), where v~e is the
    postsynaptic potential of the executed train over tau steps, then clipped to [-1, 1].
    """
    potential = postsynaptic_potential(executed, tau)
    updated = weights.copy()
    for t in range(len(executed)):
        difference = executed[t].astype(np.float64) - mental[t].astype(np.float64)
        updated += np.outer(potential[t], rates[t] * difference)
    return np.clip(updated, -1.0, 1.0)


def replay(
    weights: NDArray[np.float32],
    experience: Experience,
    trains: Iterable[tuple[NDArray[np.bool_], NDArray[np.bool_]]],
    tau: int,
) -> NDArray[np.float32]:
    """Learn R encodings of one experience, one after another.

    Args:
        weights: (n, n) w[pre, post] between the neurons of the experience; not changed.
        experience: probabilities and rates of the segment.
        trains: R pairs of spike trains (T, n), of the executed and of the mental path.
        tau: refractory period and length of the postsynaptic potential [steps].

    Returns:
        The new weights (n, n) (Tanneberg et al. 2019, "Using Mental Replay Strategies").

    """
    updated = weights.astype(np.float64)
    for executed, mental in trains:
        updated = contrast(updated, executed, mental, experience.rates, tau)
    return updated.astype(np.float32)
