# SPDX-License-Identifier: Apache-2.0
"""Means and shares with their 95 % intervals, as a report says them."""

from collections.abc import Mapping

from srnn_experiments.intervals import share_interval


def share_estimate(successes: int, count: int) -> dict[str, float]:
    """Return the share of `successes` out of `count` with its Wilson interval."""
    low, high = share_interval(successes, count)
    return {'share': successes / count, 'low': low, 'high': high}


def mean_text(estimate: Mapping[str, float]) -> str:
    """Return what `intervals.describe` found: mean ± sd [interval of the mean]."""
    mean, sd, low, high = (estimate[key] for key in ('mean', 'sd', 'low', 'high'))
    return f'{mean:.3g} ± {sd:.2g} [{low:.3g}, {high:.3g}]'


def share_text(estimate: Mapping[str, float]) -> str:
    """Return share [interval] in percent."""
    return f'{estimate["share"]:.0%} [{estimate["low"]:.0%}, {estimate["high"]:.0%}]'
