# SPDX-License-Identifier: Apache-2.0
"""Histograms of the learning signals, and the update mass that the largest of them carry."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
import numpy as np

from srnn_bringup.plots.style import INK, SIGNAL_COLOURS, SIGNAL_MARKS, figure_file, plain

SIZE = (13.0, 5.8)


def draw(found: dict[str, Any], headline: str, path: Path) -> None:
    """Draw the figure into a file."""
    with figure_file(path, SIZE, headline) as figure:
        left, right = figure.subplots(1, 2, width_ratios=[1.5, 1.0])
        for name, signal in found['signals'].items():
            if signal['count']:
                _draw_histogram(left, found, name, signal)
                _draw_mass(right, found, name, signal)
        left.set_xlim(0.0, 1.03 * found['limit'])
        left.set_ylim(bottom=0.0)
        left.yaxis.set_major_formatter(lambda share, _: f'{100 * share:.0f} %')
        left.set_xlabel('magnitude of the learning signal')
        left.set_ylabel(f'share of the signals per {found["edges"][1] - found["edges"][0]:.2g}')
        plain(left, f'signals above threshold, limited to {found["limit"]:g}')
        right.axvline(found['largest'], color=INK, lw=1.2, ls=(0, (5, 3)))
        right.plot([0.0, 1.0], [0.0, 1.0], color=INK, lw=1.0, alpha=0.4)
        for axis in (right.xaxis, right.yaxis):
            axis.set_major_formatter(lambda share, _: f'{100 * share:.0f} %')
        right.set_xlim(0.0, 1.0)
        right.set_ylim(0.0, 1.0)
        right.set_xlabel('largest signals, share of all')
        right.set_ylabel('share of the update mass')
        plain(right, 'what the largest signals carry')
        for axes, corner in ((left, 'upper right'), (right, 'lower right')):
            if axes.get_legend_handles_labels()[0]:
                axes.legend(frameon=False, fontsize=11, loc=corner)


def _draw_histogram(axes: Axes, found: dict[str, Any], name: str, signal: dict[str, Any]) -> None:
    colour = SIGNAL_COLOURS[name]
    share = np.array(signal['counts']) / signal['count']
    axes.stairs(share, found['edges'], fill=True, color=colour, alpha=0.18)
    axes.stairs(
        share, found['edges'], color=colour, lw=2.2,
        label=f'{name}: {signal["count"]} signals, {signal["at_limit"]:.0%} at the limit',
    )  # fmt: skip
    axes.axvline(signal['threshold'], color=colour, lw=1.4, ls=(0, (5, 3)))


def _draw_mass(axes: Axes, found: dict[str, Any], name: str, signal: dict[str, Any]) -> None:
    colour, mark = SIGNAL_COLOURS[name], SIGNAL_MARKS[name]
    mass = signal['mass_of_largest']
    axes.plot(
        *np.array([[0.0, 0.0], *signal['curve']]).T, color=colour, lw=2.4,
        label=f'{name}: {mass["mass"]:.0%} [{mass["low"]:.0%}, {mass["high"]:.0%}]',
    )  # fmt: skip
    axes.plot(
        found['largest'], signal['paper_mass_of_largest'], mark, mfc='none', mec=colour, ms=9,
        mew=2.0, ls='none', label=f'{name}, paper: {signal["paper_mass_of_largest"]:.0%}',
    )  # fmt: skip
