# SPDX-License-Identifier: Apache-2.0
"""One picture of a run: the path before and after learning, and what was learned."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
import numpy as np

from srnn_bringup.config import Configuration
from srnn_bringup.plots.plane import (
    draw_change,
    draw_obstacles,
    draw_waypoints,
    reach,
    show_square,
)
from srnn_bringup.plots.style import AFTER, BEFORE, DPI, OBSTACLE, TOUCH, styled
from srnn_config.geometry import outline
from srnn_config.scene import Scene
from srnn_experiments.segment_record import SegmentRecord
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses
from srnn_planner.core.synaptic_change import input_change, output_change

SIZE = (12.0, 8.2)
"""Width and height [inch]."""

LEFT, RIGHT, BAR, STRIP = (
    (0.06, 0.345, 0.405, 0.5927), (0.495, 0.345, 0.405, 0.5927),
    (0.912, 0.345, 0.012, 0.5927), (0.06, 0.075, 0.84, 0.12),
)  # fmt: skip
"""Left, bottom, width and height of the parts, as shares of the figure."""

CAPTION = 0.278
"""Height of the line under the two maps, as a share of the figure."""


@dataclass(frozen=True, eq=False)
class Story:
    """What the picture shows.

    Attributes:
        configuration: scene and network of the run.
        records: its segments.
        weights_before: weights at the start.
        weights_after: weights at the end.

    """

    configuration: Configuration
    records: Sequence[SegmentRecord]
    weights_before: Synapses
    weights_after: Synapses

    @property
    def scene(self) -> Scene:
        """Scene of the run."""
        return self.configuration.scene

    @property
    def learned_until(self) -> int:
        """Number of the last segment that changed the weights, 0 for none."""
        return max((record.number for record in self.records if record.updated), default=0)


def draw(story: Story, path: Path) -> None:
    """Draw the picture of a run into a file; its suffix selects the format."""
    with styled():
        figure = Figure(figsize=SIZE, dpi=DPI)
        left, right = figure.add_axes(LEFT), figure.add_axes(RIGHT)
        _draw_paths(left, story)
        figure.legend(
            *left.get_legend_handles_labels(), loc='center', ncols=3, frameon=False,
            bbox_to_anchor=(LEFT[0] + LEFT[2] / 2, CAPTION), handlelength=1.4, columnspacing=1.3,
        )  # fmt: skip
        image = _draw_change(right, story)
        figure.colorbar(
            image, cax=figure.add_axes(BAR), label='average change of synaptic input'
        )
        figure.text(
            RIGHT[0] + RIGHT[2] / 2, CAPTION, 'circles: neurons, larger where output has changed',
            ha='center', va='center',
        )  # fmt: skip
        draw_signal(figure.add_axes(STRIP), story.records)
        figure.savefig(path)


def _draw_paths(axes: Axes, story: Story) -> None:
    last = story.learned_until
    labels = {
        BEFORE: f'segments 1 to {last}, learning', AFTER: 'after learning'
    } if last else {AFTER: 'path of the tip'}  # fmt: skip
    for record in story.records:
        colour = BEFORE if record.number <= last else AFTER
        axes.plot(
            *record.executed.positions[:, :2].T, color=colour, lw=1.8, alpha=0.75,
            solid_capstyle='round', label=labels.pop(colour, None), zorder=3,
        )  # fmt: skip
    touches = [record.executed.positions[-1, :2] for record in story.records if record.touched]
    if touches:
        axes.plot(
            *np.array(touches).T, 'x', ms=9, mew=2.4, color=TOUCH, zorder=5,
            label=f'touches ({len(touches)})',
        )  # fmt: skip
    draw_obstacles(axes, map(outline, story.scene.obstacles), OBSTACLE)
    draw_waypoints(axes, story.scene.waypoints, story.scene.task.reach_radius)
    axes.set_title('The way round, learned by touch' if last else 'Path of the tip')
    _frame(axes, story)


def _draw_change(axes: Axes, story: Story) -> AxesImage:
    model = story.configuration.network.model
    image = draw_change(
        axes,
        model.workspace.to_metres(StateNeurons(model.network).positions),
        input_change(story.weights_after, story.weights_before),
        output_change(story.weights_after, story.weights_before),
    )
    draw_obstacles(axes, map(outline, story.scene.obstacles), 'none')
    axes.set_title('What has changed in the network')
    _frame(axes, story)
    axes.tick_params(labelleft=False)
    return image


def draw_signal(axes: Axes, records: Sequence[SegmentRecord]) -> None:
    """Draw the largest learning signal of every segment, and which ended in a contact."""
    lessons = [(record.number, record.lesson.peak) for record in records if record.lesson]
    numbers, peaks = np.array(lessons).T if lessons else np.zeros((2, 0))
    axes.bar(numbers, peaks, width=0.9, color=BEFORE)
    touches = [record.number for record in records if record.touched]
    axes.plot(touches, np.zeros(len(touches)), 'x', color=TOUCH, mew=2.2, ms=7, clip_on=False)
    count = len(records)
    axes.set_xlim(0.0, max(count, 10) + 1)
    axes.set_ylim(0.0, 1.15 * max(float(np.max(peaks, initial=0.0)), 0.05))
    axes.set_xlabel('segment')
    axes.set_title('learning signal', loc='left', fontsize=12)
    axes.spines[['top', 'right']].set_visible(False)


def _frame(axes: Axes, story: Story) -> None:
    scene = story.scene
    show_square(
        axes,
        [
            *reach(scene.waypoints, scene.task.reach_radius),
            *map(outline, scene.obstacles),
            *(record.executed.positions[:, :2] for record in story.records),
        ],
    )
