# SPDX-License-Identifier: Apache-2.0
"""How often something has happened so far, over the segments of trials."""

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator
import numpy as np

from srnn_bringup.plots.style import SINGLE


def draw_counts(
    axes: Axes, events: Sequence[Sequence[int]], end: int, colour: str, label: str
) -> None:
    """Draw the counts of single trials, and their mean.

    Args:
        axes: where to draw.
        events: of every trial, the segments in which it happened.
        end: last segment.
        colour: of the lines.
        label: of their mean.

    """
    segments = np.arange(end + 1)
    curves = np.array([np.searchsorted(numbers, segments, 'right') for numbers in events])
    for curve in curves:
        axes.plot(segments, curve, color=colour, drawstyle='steps-post', **SINGLE)
    mean = curves.mean(axis=0)
    axes.plot(segments, mean, color=colour, drawstyle='steps-post', lw=2.6, label=label)
    axes.set_xlim(0.0, 1.14 * end)
    axes.xaxis.set_major_locator(MaxNLocator(4, integer=True))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))


def draw_paper(
    axes: Axes, mean_sd: Sequence[float], at: float, colour: str, label: str | None = None
) -> None:
    """Draw mean and standard deviation of the paper beside the end of the counts."""
    mean, sd = mean_sd
    axes.errorbar(
        at, mean, sd, fmt='D', color=colour, mec='white', ms=8, capsize=4, elinewidth=1.8,
        label=label, clip_on=False,
    )  # fmt: skip
