# SPDX-License-Identifier: Apache-2.0
"""The picture of where the time of a plan goes."""

from pathlib import Path

from matplotlib.axes import Axes
from timing import Times

from srnn_bringup.plots.style import AFTER, BEFORE, INK, OBSTACLE, figure_file, plain

SIZE = (7.0, 5.6)
"""Width and height [inch]: of a phone held upright."""

PARTS = {
    'sampling': AFTER, 'selection': BEFORE, 'segment': '#8c5a8a',
    'goal: ways and context': '#5aa469', 'history': OBSTACLE, 'decoding': '#c9ada7',
}  # fmt: skip
"""Colour of each part of a plan."""

REST = 'the rest'
THIN = 0.6
"""Height of a bar, of 1."""


def draw(times: dict[str, Times], path: Path) -> None:
    """Draw a plan and its parts beside the bound of sampling and beside NumPy."""
    headline = f'Where the {times["plan"].p50:.2f} ms of a plan go'
    with figure_file(path, SIZE, headline) as figure:
        near, far = figure.subplots(2, 1, height_ratios=(1.4, 1.0))
        _parts(near, times)
        _beside(far, times)


def _parts(axes: Axes, times: dict[str, Times]) -> None:
    plan = times['plan'].p50
    widths = {name: times[name].p50 for name in PARTS}
    widths[REST] = max(plan - sum(widths.values()), 0.0)
    left = 0.0
    for name, width in widths.items():
        axes.barh(
            0.9, width, THIN, left, color=PARTS.get(name, '#dee2e6'),
            label=f'{name} {width:.2f}',
        )  # fmt: skip
        left += width
    bound = sum(t.p50 for name, t in times.items() if name.startswith('bound'))
    axes.barh(0.0, bound, THIN, color=INK, label=f'bound of sampling {bound:.2f}')
    axes.set(ylim=(-0.4, 1.3))
    axes.set_yticks([0.9, 0.0], ['plan', 'bound of\nsampling'])
    axes.legend(
        loc='upper center', bbox_to_anchor=(0.45, -0.28), ncols=2, frameon=False, fontsize=11
    )
    axes.set_xlabel('ms, p50')
    plain(axes)


def _beside(axes: Axes, times: dict[str, Times]) -> None:
    names = ('plan', 'sampling', 'plan in NumPy', 'sampling in NumPy')
    for row, name in enumerate(reversed(names)):
        width = times[name].p50
        axes.barh(row, width, 0.7, color=AFTER if 'NumPy' not in name else OBSTACLE)
        axes.text(width, row, f' {width:.2f}', va='center', fontsize=11)
    axes.set_yticks(range(len(names)), reversed(names))
    axes.margins(x=0.12)
    axes.set_xlabel('ms, p50')
    plain(axes)
