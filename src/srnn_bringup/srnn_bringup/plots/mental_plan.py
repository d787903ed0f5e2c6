# SPDX-License-Identifier: Apache-2.0
"""The mental plan over time and in the plane, for each learning signal."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpecFromSubplotSpec, SubplotSpec
import numpy as np

from srnn_bringup.plots.plane import draw_obstacles, draw_waypoints, reach, show_square
from srnn_bringup.plots.style import (
    AFTER,
    BEFORE,
    INK,
    OBSTACLE,
    REACH,
    TOUCH,
    figure_file,
    legend_above,
    plain,
)

SIZE = (13.0, 11.0)

PHASE_COLOURS = {'before': INK, 'while': BEFORE, 'after': AFTER}


def draw(found: dict[str, Any], headline: str, path: Path) -> None:
    """Draw the figure into a file."""
    with figure_file(path, SIZE, headline) as figure:
        grid = figure.add_gridspec(len(found['trials']), 1)
        for row, (name, trial) in enumerate(found['trials'].items()):
            _draw_trial(figure, grid[row], found, name, trial)


def _draw_trial(
    figure: Figure, part: SubplotSpec, found: dict[str, Any], name: str, trial: dict[str, Any]
) -> None:
    grid = GridSpecFromSubplotSpec(2, 2, part, width_ratios=[1.75, 1.0])
    x = figure.add_subplot(grid[0, 0])
    y = figure.add_subplot(grid[1, 0], sharex=x)
    for index, axes in enumerate((x, y)):
        _draw_over_time(axes, found, trial, index)
    plain(x, f'{name} signal')
    plain(y)
    x.tick_params(labelbottom=False)
    legend_above(x, 5)
    y.set_xlabel(
        f'planned execution time [s], segments 1 to {found["shown_segments"]}, '
        f'seed {found["seeds"][0]}'
    )
    _draw_plane(figure.add_subplot(grid[:, 1]), found, trial)


def _draw_over_time(axes: Axes, found: dict[str, Any], trial: dict[str, Any], index: int) -> None:
    shown = found['shown_segments']
    durations = np.array([times[-1] for times in trial['times_s'][:shown]])
    starts = np.concatenate([[0.0], np.cumsum(durations)])
    targets = [100.0 * found['place']['waypoints_m'][a][index] for a in trial['active'][:shown]]
    axes.stairs(targets, starts, baseline=None, color=REACH, lw=2.5, label='way point')
    plans, executed = [], []
    for start, times, plan, path in zip(
        starts[:-1], trial['times_s'], trial['plans_m'], trial['executed_m'], strict=False
    ):
        t = start + np.array(times)
        plans.append(np.column_stack([t, 100.0 * np.array(plan)[:, index]]))
        executed.append(np.column_stack([t, 100.0 * np.array(path)[:, index]]))
    axes.add_collection(
        LineCollection(executed, colors=BEFORE, lw=3.4, label='executed', capstyle='round')
    )
    axes.add_collection(LineCollection(plans, colors=INK, lw=1.3, label='mental plan'))
    ends = [path[-1] for path, on in zip(executed, trial['touched'], strict=False) if on]
    if ends:
        axes.plot(*np.array(ends).T, 'x', color=TOUCH, ms=8, mew=2.2, zorder=5, label='touch')
    learning = [i for i, phase in enumerate(trial['phases'][:shown]) if phase == 'while']
    if learning:
        axes.axvspan(
            starts[learning[0]], starts[learning[-1] + 1], color=BEFORE, alpha=0.13, lw=0,
            zorder=0, label='learning',
        )  # fmt: skip
    axes.set_xlim(0.0, starts[-1] or 1.0)
    axes.set_ylabel(f'{"xy"[index]} [cm]')
    axes.margins(y=0.08)
    axes.autoscale_view(scalex=False)


def _draw_plane(axes: Axes, found: dict[str, Any], trial: dict[str, Any]) -> None:
    place = found['place']
    for order, (phase, colour) in enumerate(PHASE_COLOURS.items()):
        paths = [
            np.array(plan)
            for plan, of in zip(trial['plans_m'], trial['phases'], strict=True)
            if of == phase
        ]
        if paths:
            plans = LineCollection(paths, colors=colour, lw=1.4, alpha=0.6)
            plans.set(zorder=3.0 - 0.1 * order, label=f'{phase} learning ({len(paths)})')
            axes.add_collection(plans)
    touches = [
        path[-1] for path, on in zip(trial['executed_m'], trial['touched'], strict=True) if on
    ]
    if touches:
        axes.plot(
            *np.array(touches).T, 'x', ms=8, mew=2.2, color=TOUCH, zorder=5,
            label=f'touches ({len(touches)})',
        )  # fmt: skip
    draw_obstacles(axes, place['obstacles_m'], OBSTACLE)
    draw_waypoints(axes, place['waypoints_m'], place['reach_radius_m'])
    show_square(
        axes,
        [
            *reach(place['waypoints_m'], place['reach_radius_m']),
            *place['obstacles_m'],
            *trial['plans_m'],
        ],
    )
    if trial['plans_m']:
        axes.legend(
            loc='upper center', bbox_to_anchor=(0.5, -0.09), ncols=2, frameon=False, fontsize=11,
            handlelength=1.2, columnspacing=1.0,
        )  # fmt: skip
    axes.set_title('mental plans of the whole trial', loc='left', fontsize=13)
