# SPDX-License-Identifier: Apache-2.0
"""The picture of how cost grows."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter
import numpy as np
from scale_fit import power_law
from scale_table import Found, of_times

from srnn_bringup.plots.style import AFTER, BEFORE, INK, figure_file, legend_above, plain

SIZE = (7.0, 12.5)
"""Width and height [inch]: of a phone held upright."""

MARKS = {2: 'o', 3: 's'}
HEADLINE = 'What a segment and an update cost, and how that grows'


def draw(found: Found, path: Path) -> None:
    """Draw time and memory over neurons, and time over samples and replays."""
    with figure_file(path, SIZE, HEADLINE) as figure:
        grid = figure.add_gridspec(3, 2, height_ratios=(1.25, 1.0, 0.85))
        time, memory = figure.add_subplot(grid[0, :]), figure.add_subplot(grid[1, :])
        samples, replays = figure.add_subplot(grid[2, 0]), figure.add_subplot(grid[2, 1])
        for dimensions, row in found.sizes.items():
            timed = of_times(row)
            neurons = [m.case.neurons for m, _ in timed]
            name = f'{dimensions} dim.'
            _law(time, neurons, [t.plan_ms for _, t in timed], AFTER, dimensions, f'plan, {name}')
            _law(
                time, neurons, [t.update_ms for _, t in timed], BEFORE, dimensions,
                f'update, {name}',
            )  # fmt: skip
            _law(
                memory, neurons, [1e-6 * (m.memory or 1) for m, _ in timed], INK, dimensions, name
            )
        timed = of_times(found.samples)
        _law(
            samples, [m.case.samples for m, _ in timed], [t.plan_ms for _, t in timed], AFTER,
            2, '',
        )
        timed = of_times(found.replays)
        _law(
            replays, [m.case.replays for m, _ in timed], [t.update_ms for _, t in timed], BEFORE,
            2, '',
        )  # fmt: skip
        for axes, title, x in (
            (time, 'ms', 'neurons'), (memory, 'MB at most', 'neurons'),
            (samples, 'ms a plan', 'samples'), (replays, 'ms an update', 'replays'),
        ):  # fmt: skip
            _frame(axes, title, x)
        legend_above(time, 2)
        legend_above(memory, 2)


def _law(
    axes: Axes, x: Sequence[float], y: Sequence[float], colour: str, dimensions: int, name: str
) -> None:
    """Draw points and, where there are two, the power law through them."""
    label = name
    if len(x) > 1:
        law = power_law(x, y)
        label = f'{name}: ^{law.exponent:.2f}' if name else f'^{law.exponent:.2f}'
        ends = np.array([min(x), max(x)], dtype=np.float64)
        axes.plot(ends, law.at(ends), color=colour, lw=1.4, alpha=0.6, ls=(0, (4, dimensions)))
    axes.plot(x, y, MARKS[dimensions], color=colour, ms=8, label=label, mec='white')


def _frame(axes: Axes, title: str, x: str) -> None:
    plain(axes, title)
    axes.set(xscale='log', yscale='log', xlabel=x)
    axes.grid(which='major', alpha=0.3)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f'{value:g}'))
