# SPDX-License-Identifier: Apache-2.0
"""The learning signals over the segments, and how many updates they triggered."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator
import numpy as np

from srnn_bringup.plots.style import INK, SIGNAL_COLOURS, SINGLE, figure_file, legend_above, plain

SIZE = (13.0, 8.4)

UNITS = {'global': 'largest global signal [units²]', 'local': 'largest local signal'}


def draw(found: dict[str, Any], headline: str, path: Path) -> None:
    """Draw the figure into a file."""
    with figure_file(path, SIZE, headline) as figure:
        rows = figure.subplots(
            len(found['signals']), 2, sharex='col', width_ratios=[2.3, 1.0], squeeze=False
        )
        for (left, right), (name, signal) in zip(rows, found['signals'].items(), strict=True):
            _draw_peaks(left, found, name, signal)
            _draw_updates(right, found, name, signal)
        for axes in rows[-1]:
            axes.set_xlabel('segment')
        for right in rows[:, 1]:
            right.set_ylim(0.0, max(axes.get_ylim()[1] for axes in rows[:, 1]))


def _draw_peaks(axes: Axes, found: dict[str, Any], name: str, signal: dict[str, Any]) -> None:
    colour = SIGNAL_COLOURS[name]
    numbers = np.concatenate([np.arange(1, len(peaks) + 1) for peaks in signal['peaks']])
    values = np.concatenate(signal['peaks'])
    pairs = zip(signal['peaks'], signal['update_segments'], strict=True)
    updated = np.concatenate([np.isin(np.arange(1, len(p) + 1), u) for p, u in pairs])
    axes.plot(
        numbers[~updated], values[~updated], 'o', color=INK, ms=2.6, alpha=0.3, mew=0,
        label='no update',
    )  # fmt: skip
    axes.plot(
        numbers[updated], values[updated], 'o', color=colour, ms=7.0, alpha=0.75, mec='white',
        label='update',
    )  # fmt: skip
    width, mean = found['bin_segments'], signal['mean_peaks']
    edges = np.minimum(width * np.arange(len(mean) + 1), found['segments']) + 0.5
    axes.stairs(
        mean, edges, baseline=None, color=colour, lw=2.4, label=f'mean of {width} segments'
    )
    axes.axhline(
        signal['threshold'], color=INK, lw=1.6, ls=(0, (5, 3)),
        label=f'threshold {signal["threshold"]:g}',
    )  # fmt: skip
    axes.set_yscale('log')
    axes.set_xlim(0.0, found['segments'] + 1)
    axes.set_ylabel(UNITS[name])
    plain(axes, f'{name} signal')
    legend_above(axes, 4)


def _draw_updates(axes: Axes, found: dict[str, Any], name: str, signal: dict[str, Any]) -> None:
    colour, end = SIGNAL_COLOURS[name], found['segments']
    segments = np.arange(end + 1)
    curves = np.array(
        [np.searchsorted(numbers, segments, 'right') for numbers in signal['update_segments']]
    )
    for number, curve in enumerate(curves):
        label = None if number else 'trial'
        axes.plot(segments, curve, color=colour, drawstyle='steps-post', label=label, **SINGLE)
    mean_curve = curves.mean(axis=0)
    axes.plot(segments, mean_curve, color=colour, drawstyle='steps-post', lw=2.6, label='mean')
    mean, sd = signal['paper_updates']
    axes.errorbar(
        1.06 * end, mean, sd, fmt='D', color=INK, ms=6, capsize=4, label='paper', clip_on=False
    )
    axes.set_xlim(0.0, 1.12 * end)
    axes.xaxis.set_major_locator(MaxNLocator(4, integer=True))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylabel('updates so far')
    plain(axes)
    legend_above(axes, 3)
