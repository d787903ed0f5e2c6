# SPDX-License-Identifier: Apache-2.0
"""How sure one can be: intervals that hold the true value in 95 of 100 cases."""

from collections.abc import Callable, Sequence
from math import sqrt

import numpy as np
from numpy.typing import NDArray

RESAMPLES = 10_000
TRIAL_RESAMPLES = 1000
"""Of single values, and of whole trials, with which everything is computed again."""

SEED = 20190101
"""Resampling is repeatable: a report shows the same intervals every time."""

_Z = 1.959964


def mean_interval(values: Sequence[float]) -> tuple[float, float]:
    """Return the 95 % bootstrap interval of the mean (percentiles of resampled means)."""
    data = np.asarray(values, dtype=np.float64)
    if len(data) == 0:
        return float('nan'), float('nan')
    picks = np.random.default_rng(SEED).integers(0, len(data), (RESAMPLES, len(data)))
    low, high = np.percentile(data[picks].mean(axis=1), [2.5, 97.5])
    return float(low), float(high)


def paired_interval(a: Sequence[float], b: Sequence[float]) -> tuple[float, float]:
    """Return the 95 % interval of the mean of a - b, pair by pair (same seeds).

    Raises:
        ValueError: the two do not have the same length.

    """
    if len(a) != len(b):
        raise ValueError(f'{len(a)} and {len(b)} values cannot be paired')
    return mean_interval([x - y for x, y in zip(a, b, strict=True)])


def describe(values: Sequence[float]) -> dict[str, float]:
    """Return mean, standard deviation of the sample, and the 95 % interval of the mean."""
    mean = sum(values) / len(values)
    sd = (sum((v - mean) ** 2 for v in values) / max(len(values) - 1, 1)) ** 0.5
    low, high = mean_interval(values)
    return {'mean': mean, 'sd': sd, 'low': low, 'high': high}


def trial_interval(
    trials: int, statistic: Callable[[NDArray[np.float64]], float]
) -> tuple[float, float]:
    """Return the 95 % bootstrap interval of a statistic over values that share trials.

    Whole trials are resampled, because what happens within one is not independent.

    Args:
        trials: how many there are.
        statistic: takes how often each trial counts (trials,) and returns the statistic.

    """
    values = [statistic(weights) for weights in trial_weights(trials)]
    low, high = np.percentile(values, [2.5, 97.5], method='inverted_cdf')
    return float(low), float(high)


def trial_weights(trials: int) -> NDArray[np.float64]:
    """Return how often each trial counts in every resample, (TRIAL_RESAMPLES, trials)."""
    shares = np.full(trials, 1.0 / trials)
    rng = np.random.default_rng(SEED)
    return rng.multinomial(trials, shares, size=TRIAL_RESAMPLES).astype(np.float64)


def share_interval(successes: int, count: int) -> tuple[float, float]:
    """Return the 95 % Wilson interval of a share of `successes` out of `count`."""
    if count == 0:
        return 0.0, 1.0
    share = successes / count
    middle = share + _Z**2 / (2 * count)
    half = _Z * sqrt(share * (1.0 - share) / count + _Z**2 / (4 * count**2))
    scale = 1.0 + _Z**2 / count
    return max(0.0, (middle - half) / scale), min(1.0, (middle + half) / scale)
