# SPDX-License-Identifier: Apache-2.0
"""How long visits of the blocked way point take, and which were never completed."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator
import numpy as np

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
            _draw_unfinished(right, name, signal)
        left.set_yscale('log')
        left.yaxis.set_major_formatter('{x:g}')
        left.xaxis.set_major_locator(MaxNLocator(integer=True))
        left.set_xlabel(f'visit of way point {found["waypoint"]}')
        left.set_ylabel('segments needed')
        left.plot([], [], '^', color=INK, ms=7.5, mfc='none', mew=1.6, label='cut off')
        plain(left)
        legend_above(left, 4)
        right.set_xscale('log')
        right.xaxis.set_major_formatter('{x:g}')
        right.set_xlim(1.0, max(found['segments'], 2))
        right.set_ylim(0.0, 1.02)
        right.yaxis.set_major_formatter(lambda share, _: f'{100 * share:.0f} %')
        right.set_xlabel('segments')
        right.set_ylabel('visits still unfinished, all together')
        plain(right)
        legend_above(right, 3)


def _draw_visits(axes: Axes, found: dict[str, Any], name: str, signal: dict[str, Any]) -> None:
    colour, beside = SIGNAL_COLOURS[name], BESIDE[name]
    dots = [(v['visit'] + beside, n) for v in signal['by_visit'] for n in v['completed']]
    open_ones = [(v['visit'] + beside, n) for v in signal['by_visit'] for n in v['cut_off_after']]
    mark = SIGNAL_MARKS[name]
    if dots:
        axes.plot(*np.array(dots).T, mark, color=colour, ms=4.5, alpha=0.45, mew=0)
    if open_ones:
        axes.plot(*np.array(open_ones).T, '^', color=colour, ms=7.5, mfc='none', mew=1.6)
    most = len(found['seeds'])
    known = [
        v for v in signal['by_visit']
        if v['median'] is not None
        and 2 * (len(v['completed']) + len(v['cut_off_after'])) >= most
    ]  # fmt: skip
    if known:
        x = [v['visit'] + beside for v in known]
        median = np.array([v['median'] for v in known])
        low, high = (
            np.array([v[end] or found['segments'] for v in known]) for end in ('low', 'high')
        )
        bars = np.maximum((median - low, high - median), 0.0)
        axes.errorbar(
            x, median, bars, color=colour, lw=2.0, elinewidth=1.6, capsize=2.5,
            marker=mark, ms=7, mec='white', label=name,
        )  # fmt: skip


def _draw_unfinished(axes: Axes, name: str, signal: dict[str, Any]) -> None:
    curve, colour = signal['unfinished'], SIGNAL_COLOURS[name]
    segments = np.arange(1, len(curve['share']) + 1)
    axes.fill_between(
        segments, curve['low'], curve['high'], step='post', color=colour, alpha=0.16, lw=0
    )
    axes.plot(
        segments, curve['share'], drawstyle='steps-post', color=colour, lw=2.4,
        label=f'{name}: {signal["begun"] - signal["cut_off"]} of {signal["begun"]} done',
    )  # fmt: skip
