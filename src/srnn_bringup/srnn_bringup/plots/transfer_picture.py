# SPDX-License-Identifier: Apache-2.0
"""One trial of the transfer experiment: until the last touch, and afterwards."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
import numpy as np

from srnn_bringup.picture import CAPTION, SIZE, draw_signal
from srnn_bringup.plots.plane import draw_obstacles, draw_waypoints, reach, show_square
from srnn_bringup.plots.style import AFTER, BEFORE, DPI, INK, OBSTACLE, TOUCH, styled
from srnn_config.geometry import outline
from srnn_config.scene import Obstacle, Scene
from srnn_experiments.segment_record import SegmentRecord

LEFT, RIGHT, STRIP = (
    (0.06, 0.345, 0.405, 0.5927), (0.555, 0.345, 0.405, 0.5927), (0.06, 0.075, 0.9, 0.12)
)  # fmt: skip
"""Left, bottom, width and height of the parts, as shares of the figure."""

NEW = '#e9c46a'
"""Colour of the obstacle that the weights know nothing of when the trial begins."""


@dataclass(frozen=True, eq=False)
class TransferStory:
    """What the picture shows.

    Attributes:
        title: which trial it is.
        scene: the target scene.
        new: its obstacles that the source scene has not.
        records: segments of the trial.

    """

    title: str
    scene: Scene
    new: Sequence[Obstacle]
    records: Sequence[SegmentRecord]

    @property
    def touched_until(self) -> int:
        """Number of the last segment that ended in a contact, 0 for none."""
        return max((record.number for record in self.records if record.touched), default=0)


def draw(story: TransferStory, path: Path) -> None:
    """Draw the picture of a trial into a file; its suffix selects the format."""
    last, end = story.touched_until, len(story.records)
    with styled():
        figure = Figure(figsize=SIZE, dpi=DPI)
        left, right = figure.add_axes(LEFT), figure.add_axes(RIGHT)
        _draw_map(left, story, story.records[:last], BEFORE)
        left.set_title(f'Until the last touch: {_segments(1, last)}')
        _draw_map(right, story, story.records[last:], AFTER)
        right.set_title(f'Afterwards: {_segments(last + 1, end)}')
        right.tick_params(labelleft=False)
        figure.legend(
            handles=_legend(sum(record.touched for record in story.records)), loc='center',
            ncols=5, frameon=False, bbox_to_anchor=(0.5, CAPTION), handlelength=1.4,
            columnspacing=1.6,
        )  # fmt: skip
        strip = figure.add_axes(STRIP)
        draw_signal(strip, story.records)
        strip.set_title(story.title, loc='right', fontsize=12)
        figure.savefig(path)


def _draw_map(
    axes: Axes, story: TransferStory, records: Sequence[SegmentRecord], colour: str
) -> None:
    for record in records:
        axes.plot(
            *record.executed.positions[:, :2].T, color=colour, lw=1.8, alpha=0.75,
            solid_capstyle='round', zorder=3,
        )  # fmt: skip
    touches = [record.executed.positions[-1, :2] for record in records if record.touched]
    if touches:
        axes.plot(*np.array(touches).T, 'x', ms=9, mew=2.4, color=TOUCH, zorder=5)
    scene = story.scene
    outlines = [outline(obstacle) for obstacle in scene.obstacles]
    draw_obstacles(axes, outlines, OBSTACLE)
    draw_obstacles(axes, map(outline, story.new), NEW)
    draw_waypoints(axes, scene.waypoints, scene.task.reach_radius)
    everywhere = [record.executed.positions[:, :2] for record in story.records]
    show_square(axes, [*reach(scene.waypoints, scene.task.reach_radius), *outlines, *everywhere])


def _legend(touches: int) -> list[Line2D | Patch]:
    cross = Line2D(
        [], [], ls='', marker='x', ms=9, mew=2.4, color=TOUCH, label=f'touches ({touches})'
    )
    return [
        Patch(fc=OBSTACLE, ec=INK, lw=1.8, label='first obstacle, learned in phase 1'),
        Patch(fc=NEW, ec=INK, lw=1.8, label='new obstacle'),
        Line2D([], [], color=BEFORE, lw=1.8, label='path while learning'),
        Line2D([], [], color=AFTER, lw=1.8, label='path afterwards'),
        cross,
    ]


def _segments(first: int, last: int) -> str:
    if last < first:
        return 'no segment'
    return f'segment {first}' if first == last else f'segments {first} to {last}'
