# SPDX-License-Identifier: Apache-2.0
"""Spikes into continuous states through a Gaussian window."""

import numpy as np
from numpy.typing import NDArray


def window(steps: int, history: int, sigma: float) -> NDArray[np.float64]:
    """Return the filter (T, history + T) that smooths activity over time.

    Row t is a Gaussian of width `sigma` steps around step t; the window sees the
    history before step 0 and ends with the last step.
    """
    lag = np.arange(history + steps)[None, :] - (history + np.arange(steps))[:, None]
    return np.asarray(np.exp(-0.5 * (lag / sigma) ** 2))


def decode(
    activity: NDArray[np.float64], filter_: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Decode x_t = sum_k v^_tk p_k / sum_k v^_tk for each sample.

    The window is linear, so it is applied to the d + 1 sums instead of to K trains
    (Tanneberg et al. 2019, "Encoding continuous domains with binary neurons").

    Args:
        activity: (S, history + T, d + 1) sums of spiking positions and their counts.
        filter_: (T, history + T) see `window`.

    Returns:
        paths: (S, T, d) in units; meaningless where a sample is not valid.
        valid: (S,) whether every step of a sample has spikes in reach of its window.

    """
    samples, _, columns = activity.shape
    # One product for all samples takes a fifth of the time of one for each.
    sums = np.ascontiguousarray(activity.transpose(1, 0, 2)).reshape(filter_.shape[1], -1)
    filtered = (filter_ @ sums).reshape(-1, samples, columns).transpose(1, 0, 2)
    weight = filtered[:, :, -1:]
    # A count this small is the far tail of the window, not activity.
    valid = np.asarray((weight[:, :, 0] > 1e-2).all(axis=1))
    paths = filtered[:, :, :-1] / np.maximum(weight, 1e-2)
    return paths, valid


def spike_activity(
    spikes: NDArray[np.bool_],
    history: NDArray[np.int32],
    positions: NDArray[np.float64],
    tau: int,
) -> NDArray[np.float64]:
    """Return (S, tau + T, d + 1) sums of positions and counts; the kernel's reference.

    Args:
        spikes: (S, T, K) spikes of the samples.
        history: (S, K) step of the last spike before 0.
        positions: (K, d) preferred positions.
        tau: length of the history [steps].

    """
    before = np.stack([history == step for step in range(-tau, 0)], axis=1)
    trains = np.concatenate([before, spikes], axis=1).astype(np.float64)
    columns = np.column_stack([positions, np.ones(len(positions))])
    return np.asarray(trains @ columns)
