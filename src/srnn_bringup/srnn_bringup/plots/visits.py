# SPDX-License-Identifier: Apache-2.0
"""How long visits of the blocked way point take, and which were never completed."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator
import numpy as np

from srnn_bringup.plots.counts import draw_counts, draw_paper
from srnn_bringup.plots.style import (
    INK,
    SIGNAL_COLOURS,
    SIGNAL_MARKS,
    figure_file,
    legend_above,
    plain,
)

SIZE = (13.0, 6.2)

BESIDE = {'none': -0.22, 'global': 0.0, 'local': 0.22}
"""Signals stand beside each other at each visit."""


def draw(found: dict[str, Any], headline: str, path: Path) -> None:
    """Draw the figure into a file."""
    with figure_file(path, SIZE, headline) as figure:
        left, right = figure.subplots(1, 2, width_ratios=[1.5, 1.0])
        for name, signal in found['signals'].items():
            _draw_visits(left, found, name, signal)
            _draw_so_far(right, found, name, signal)
        left.set_yscale('log')
        left.yaxis.set_major_formatter('{x:g}')
        left.xaxis.set_major_locator(MaxNLocator(integer=True))
        left.set_xlim(left=0.4)
        left.set_xlabel(f'visit of way point {found["waypoint"]}')
        left.set_ylabel('segments needed')
        left.plot([], [], '^', color=INK, ms=7.5, mfc='none', mew=1.6, label='cut off')
        right.plot([], [], 'D', color=INK, ms=8, mec='white', label='paper')
        right.set_xlabel('segment')
        right.set_ylabel('visits so far')
        right.set_ylim(bottom=0.0)
        for axes in (left, right):
            plain(axes)
            legend_above(axes, 4)


def _draw_visits(axes: Axes, found: dict[str, Any], name: str, signal: dict[str, Any]) -> None:
    colour, beside = SIGNAL_COLOURS[name], BESIDE[name]
    dots = [(v['visit'] + beside, n) for v in signal['by_visit'] for n in v['completed']]
    open_ones = [(v['visit'] + beside, n) for v in signal['by_visit'] for n in v['cut_off_after']]
    mark = SIGNAL_MARKS[name]
    if dots:
        axes.plot(*np.array(dots).T, mark, color=colour, ms=4.5, alpha=0.45, mew=0)
    if open_ones:
        axes.plot(*np.array(open_ones).T, '^', color=colour, ms=7.5, mfc='none', mew=1.6)
    known = [
        v for v in signal['by_visit']
        if v['spent_per_visit'] is not None
        and 2 * (len(v['completed']) + len(v['cut_off_after'])) >= len(found['seeds'])
    ]  # fmt: skip
    if known:
        x = [v['visit'] + beside for v in known]
        spent = np.array([v['spent_per_visit'] for v in known])
        low = np.array([v['low'] for v in known])
        high = np.array([v['high'] or v['spent_per_visit'] for v in known])
        axes.errorbar(
            x, spent, np.maximum((spent - low, high - spent), 0.0), color=colour, lw=2.0,
            elinewidth=1.6, marker=mark, ms=7, mec='white', label=name,
        )  # fmt: skip


def _draw_so_far(axes: Axes, found: dict[str, Any], name: str, signal: dict[str, Any]) -> None:
    end, colour = found['segments'], SIGNAL_COLOURS[name]
    draw_counts(axes, signal['completed_at'], end, colour, name)
    if signal['paper'] is not None:
        draw_paper(axes, signal['paper'], (1.07 + 0.1 * BESIDE[name]) * end, colour)
