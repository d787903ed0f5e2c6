# SPDX-License-Identifier: Apache-2.0
"""Trials with constant rates over many segments, with and without a trigger."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator
import numpy as np
from numpy.typing import NDArray

from srnn_bringup.plots.plane import (
    draw_change,
    draw_obstacles,
    draw_waypoints,
    reach,
    show_square,
)
from srnn_bringup.plots.style import INK, SINGLE, figure_file, plain

SIZE = (13.0, 14.0)

COLOURS = {'constant': '#0072b2', 'untriggered': '#d55e00'}
LABELS = {'constant': 'with trigger', 'untriggered': 'without trigger'}

ROWS = {
    'reached': ('way points reached\nper 100 segments', 100.0),
    'touched': ('touches\nper 100 segments', 100.0),
    'planned_m': ('planned path\nof a segment [cm]', 100.0),
    'invalid_plans': ('invalid plans\nper 100 segments', 100.0),
}
"""Name of every series, what it is called, and the factor to that unit."""


def draw(found: dict[str, Any], headline: str, path: Path) -> None:
    """Draw the figure into a file."""
    rates = found['rates']
    with figure_file(path, SIZE, headline) as figure:
        grid = figure.subplots(len(ROWS) + 1, len(rates), height_ratios=[1.0] * len(ROWS) + [2.3])
        for column, rate in enumerate(rates):
            for row, name in enumerate(ROWS):
                axes = grid[row, column]
                _draw_series(axes, found, rate, name)
                plain(axes, _states(found, rate) if row == 0 else '')
                axes.tick_params(labelbottom=row == len(ROWS) - 1, labelleft=column == 0)
            grid[len(ROWS) - 1, column].set_xlabel('segment')
        for row, (name, (label, _)) in enumerate(ROWS.items()):
            for axes in grid[row]:
                axes.set_ylim(0.0, 1.06 * _largest(found, name) or 1.0)
            grid[row, 0].set_ylabel(label)
        figure.legend(
            *grid[0, 0].get_legend_handles_labels(), loc='upper right', ncols=2, frameon=False,
            bbox_to_anchor=(0.995, 0.999),
        )  # fmt: skip
        _draw_changes(grid[-1], found)


def _draw_series(axes: Axes, found: dict[str, Any], rate: float, name: str) -> None:
    centres = found['bin_segments'] * (np.arange(_bins(found)) + 0.5)
    for signal in found['triggers']:
        setting, colour = found['settings'][f'{signal} {rate:g}'], COLOURS[signal]
        for one in setting['trials'][name]:
            values = _scaled(one, name)
            axes.plot(centres, values, color=colour, **SINGLE)
            seen = np.flatnonzero(np.isfinite(values))
            if 0 < len(seen) < len(values):
                axes.plot(centres[seen[-1]], values[seen[-1]], 'x', color=colour, ms=7, mew=2.0)
        axes.plot(
            centres, _scaled(setting['mean'][name], name), color=colour, lw=2.4,
            label=LABELS[signal],
        )  # fmt: skip
    axes.set_xlim(0.0, found['segments'])


def _draw_changes(row: NDArray[Any], found: dict[str, Any]) -> None:
    """Draw what the untriggered rates have changed, each on a scale of its own."""
    signal, place = found['triggers'][1], found['place']
    for axes, rate in zip(row, found['rates'], strict=True):
        setting = found['settings'][f'{signal} {rate:g}']
        image = draw_change(
            axes, np.array(found['neurons_m']), np.array(setting['input']),
            np.array(setting['output']),
        )  # fmt: skip
        draw_obstacles(axes, place['obstacles_m'], 'none')
        draw_waypoints(axes, place['waypoints_m'], place['reach_radius_m'])
        show_square(
            axes, [*reach(place['waypoints_m'], place['reach_radius_m']), *place['obstacles_m']]
        )
        axes.tick_params(labelleft=axes is row[0])
        states = setting['states']
        axes.set_title(
            f'{LABELS[signal]}, rate {rate:g}:\n{states.count("collapsed")} collapsed, '
            f'{states.count("stranded")} stranded, {states.count("fine")} fine',
            fontsize=12, color=INK,
        )  # fmt: skip
        axes.figure.colorbar(
            image, ax=axes, orientation='horizontal', label='average change of synaptic input',
            shrink=0.9, aspect=28, ticks=MaxNLocator(5, symmetric=True),
        )  # fmt: skip


def _states(found: dict[str, Any], rate: float) -> str:
    fine = []
    for signal in found['triggers']:
        states = found['settings'][f'{signal} {rate:g}']['states']
        fine.append(f'{states.count("fine")} of {len(states)} {LABELS[signal]}')
    return f'rate {rate:g}, fine: {fine[0]},\n{", ".join(fine[1:])}'


def _largest(found: dict[str, Any], name: str) -> float:
    """Return the largest value of a series over all trials, 0 if there is none."""
    series = [one for s in found['settings'].values() for one in s['trials'][name]]
    return float(np.nanmax([0.0, *np.ravel([_scaled(one, name) for one in series])]))


def _bins(found: dict[str, Any]) -> int:
    return int(found['segments'] // found['bin_segments'])


def _scaled(values: list[float | None], name: str) -> NDArray[np.float64]:
    return ROWS[name][1] * np.array(values, dtype=np.float64)
