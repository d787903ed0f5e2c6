# SPDX-License-Identifier: Apache-2.0
"""The picture of how cost grows."""

from collections.abc import Callable, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
import numpy as np
from scale_fit import power_law
from scale_run import Measured, Times
from scale_table import Found, of_times

from srnn_bringup.plots.style import AFTER, BEFORE, INK, figure_file, legend_above, plain

SIZE = (7.0, 12.0)
"""Width and height [inch]: of a phone held upright."""

MARKS = {2: 'o', 3: 's'}
HEADLINE = 'How the cost of a segment grows'


def draw(found: Found, path: Path) -> None:
    """Draw time and memory over neurons, and time over samples and replays."""
    with figure_file(path, SIZE, HEADLINE) as figure:
        grid = figure.add_gridspec(3, 2, height_ratios=(1.25, 1.0, 0.85))
        time, memory = figure.add_subplot(grid[0, :]), figure.add_subplot(grid[1, :])
        for dimensions, row in found.sizes.items():
            name, mark = f'{dimensions}-D', MARKS[dimensions]
            timed = of_times(row)
            neurons = [m.case.neurons for m, _ in timed]
            for axes, colour, label, y in (
                (time, AFTER, f'plan, {name}', [t.plan_ms for _, t in timed]),
                (time, BEFORE, f'update, {name}', [t.update_ms for _, t in timed]),
                (memory, INK, name, [1e-6 * (m.memory or 1) for m, _ in timed]),
            ):
                exponent = _points(axes, neurons, y, colour, mark)
                axes.plot([], [], mark, ms=8, color=colour, label=f'{label}{exponent}')
        _frame(time, 'ms', 'neurons')
        _frame(memory, 'MB of memory', 'neurons')
        legend_above(time, 2)
        legend_above(memory, 2)
        _series(
            figure.add_subplot(grid[2, 0]), found.samples, 'samples', AFTER, 'ms a plan',
            lambda m, t: (m.case.samples, t.plan_ms),
        )  # fmt: skip
        _series(
            figure.add_subplot(grid[2, 1]), found.replays, 'replays', BEFORE, 'ms an update',
            lambda m, t: (m.case.replays, t.update_ms),
        )  # fmt: skip


def _series(
    axes: Axes, row: list[Measured], name: str, colour: str, title: str,
    point: Callable[[Measured, Times], tuple[int, float]],
) -> None:  # fmt: skip
    x, y = zip(*(point(m, t) for m, t in of_times(row)), strict=True)
    exponent = _points(axes, x, y, colour, MARKS[2])
    _frame(axes, f'{title}{exponent}', name)
    axes.set_xticks(x, map(str, x), fontsize=10)


def _points(
    axes: Axes, x: Sequence[float], y: Sequence[float], colour: str, mark: str
) -> str:
    """Draw points and, where there are two, the power law through them; return it in words."""
    axes.plot(x, y, mark, color=colour, ms=8)
    if len(x) < 2:
        return ''
    law = power_law(x, y)
    ends = np.array([min(x), max(x)], dtype=np.float64)
    axes.plot(ends, law.at(ends), color=colour, lw=1.4, ls='--', alpha=0.6)
    return f': exponent {law.exponent:.2f}'


def _frame(axes: Axes, title: str, x: str) -> None:
    plain(axes, title)
    axes.set(xscale='log', yscale='log', xlabel=x)
    axes.grid(which='major', alpha=0.3)
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f'{value:g}'))
        axis.set_minor_formatter(NullFormatter())
