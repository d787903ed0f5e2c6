# SPDX-License-Identifier: Apache-2.0
"""The learning signals over the segments, and how many updates they triggered."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
import numpy as np

from srnn_bringup.plots.counts import draw_counts, draw_paper
from srnn_bringup.plots.style import INK, SIGNAL_COLOURS, figure_file, legend_above, plain

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
    end = found['segments']
    draw_counts(axes, signal['update_segments'], end, SIGNAL_COLOURS[name], 'mean')
    draw_paper(axes, signal['paper_updates'], 1.07 * end, INK, 'paper')
    axes.set_ylabel('updates so far')
    plain(axes)
    legend_above(axes, 2)
