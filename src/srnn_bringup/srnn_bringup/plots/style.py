# SPDX-License-Identifier: Apache-2.0
"""Colours, type and lines that all pictures share; the colours differ for the colour-blind too."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from textwrap import fill
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

DPI = 150

BEFORE, AFTER, TOUCH, INK = '#e08e45', '#1f6f8b', '#c1121f', '#2b2d42'
OBSTACLE, REACH, NEURON = '#8d99ae', '#adb5bd', '#6c757d'

SIGNAL_COLOURS = {'none': '#6c757d', 'global': '#d55e00', 'local': '#0072b2'}
SIGNAL_MARKS = {'none': 's', 'global': 'D', 'local': 'o'}

CHARACTERS = 7.0
"""Of a headline, in an inch."""

SINGLE: Any = {'lw': 0.9, 'alpha': 0.35}
"""Line of one trial among many."""

_STYLE: Any = {
    'axes.edgecolor': REACH, 'axes.labelcolor': INK, 'axes.titlesize': 14,
    'axes.labelsize': 12, 'font.size': 12, 'text.color': INK,
    'xtick.color': INK, 'ytick.color': INK, 'xtick.labelsize': 11, 'ytick.labelsize': 11,
}  # fmt: skip


@contextmanager
def styled() -> Iterator[None]:
    """Draw in the common style."""
    with rc_context(_STYLE):
        yield


@contextmanager
def figure_file(path: Path, size: tuple[float, float], headline: str) -> Iterator[Figure]:
    """Give a figure of `size` [inch] with a headline, and write it to a file at the end."""
    with styled():
        pads = ConstrainedLayoutEngine(w_pad=0.07, h_pad=0.07)
        figure = Figure(figsize=size, dpi=DPI, layout=pads)
        text = fill(headline, round(CHARACTERS * size[0]))
        figure.suptitle(text, x=0.012, ha='left', fontsize=15, fontweight='bold')
        yield figure
        figure.savefig(path)


def signed(value: float, decimals: int) -> str:
    """Return a number with its sign, which is as long as that of an axis."""
    return f'{value:+.{decimals}f}'.replace('-', '−')


def legend_above(axes: Axes, columns: int) -> None:
    """Put the legend on the right above the axes, where it hides nothing."""
    axes.legend(
        loc='lower right', bbox_to_anchor=(1.0, 0.98), ncols=columns, frameon=False, fontsize=11,
        handlelength=1.5, columnspacing=1.0, borderpad=0.1, handletextpad=0.5,
    )  # fmt: skip


def plain(axes: Axes, title: str = '') -> None:
    """Take away what frames a diagram without need, and name it."""
    axes.spines[['top', 'right']].set_visible(False)
    axes.set_title(title, loc='left', fontsize=13)
