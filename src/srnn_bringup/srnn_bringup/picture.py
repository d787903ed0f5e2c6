# SPDX-License-Identifier: Apache-2.0
"""One picture of a run: the path before and after learning, and what was learned."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Circle, Polygon
from matplotlib.ticker import MultipleLocator
import numpy as np
from numpy.typing import NDArray

from srnn_bringup.config import Configuration
from srnn_config.geometry import outline
from srnn_config.scene import EDGE, Obstacle, Scene
from srnn_experiments.segment_record import SegmentRecord
from srnn_planner.core.state_neurons import StateNeurons
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

DPI = 150

BEFORE, AFTER, TOUCH, INK = '#e08e45', '#1f6f8b', '#c1121f', '#2b2d42'
OBSTACLE, REACH, NEURON = '#8d99ae', '#adb5bd', '#6c757d'
NEURON_AREA = 130.0
"""Area of the neuron whose output changed most [square points]."""

STYLE: Any = {
    'axes.edgecolor': REACH, 'axes.labelcolor': INK, 'axes.titlesize': 14,
    'axes.labelsize': 12, 'font.size': 12, 'text.color': INK,
    'xtick.color': INK, 'ytick.color': INK, 'xtick.labelsize': 11, 'ytick.labelsize': 11,
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Story:
    """What the picture shows.

    Attributes:
        configuration: scene and network of the run.
        records: its segments.
        weights_before: (K, K) weights at the start.
        weights_after: (K, K) weights at the end.

    """

    configuration: Configuration
    records: Sequence[SegmentRecord]
    weights_before: NDArray[np.float32]
    weights_after: NDArray[np.float32]

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
    with rc_context(STYLE):
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
    draw_obstacles(axes, story.scene.obstacles, OBSTACLE)
    draw_waypoints(axes, story.scene)
    axes.set_title('The way round, learned by touch' if last else 'Path of the tip')
    frame(axes, story.scene, story.records)


def draw_waypoints(axes: Axes, scene: Scene) -> None:
    """Draw the way points of a scene with their numbers, and where they count as reached."""
    for number, point in enumerate(scene.waypoints, start=1):
        radius = scene.task.reach_radius
        axes.add_patch(Circle(point, radius, fill=False, ec=REACH, lw=1.2, ls=(0, (4, 3))))
        axes.plot(*point, 'o', ms=17, mfc='white', mec=INK, mew=1.5, zorder=6)
        axes.annotate(
            str(number), point, ha='center', va='center_baseline', fontsize=11, zorder=7
        )


def _draw_change(axes: Axes, story: Story) -> AxesImage:
    network = story.configuration.network.model.network
    extent = story.configuration.network.model.workspace.half_extent
    side = network.neurons_per_dimension
    received = input_change(story.weights_after, story.weights_before)
    sent = np.abs(output_change(story.weights_after, story.weights_before))
    limit = float(np.abs(received).max()) or 1.0
    edge = extent * side / (side - 1)
    image = axes.imshow(
        received.reshape(side, side).T, origin='lower', extent=(-edge, edge, -edge, edge),
        cmap='RdBu_r', vmin=-limit, vmax=limit, interpolation='hermite',
    )  # fmt: skip
    area = 4.0 + NEURON_AREA * sent / (float(sent.max()) or 1.0)
    neurons = extent * StateNeurons(network).positions
    x, y = neurons.T
    axes.scatter(x, y, s=area, color='white', ec=NEURON, lw=0.8, alpha=0.9, zorder=4)
    draw_obstacles(axes, story.scene.obstacles, 'none')
    axes.set_title('What has changed in the network')
    frame(axes, story.scene, story.records)
    axes.tick_params(labelleft=False)
    return image


def draw_obstacles(axes: Axes, obstacles: Iterable[Obstacle], colour: str) -> None:
    """Draw obstacles as they stand in the plane."""
    for obstacle in obstacles:
        axes.add_patch(Polygon(outline(obstacle), fc=colour, ec=INK, lw=1.8, zorder=4.5))


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


def frame(axes: Axes, scene: Scene, records: Sequence[SegmentRecord]) -> None:
    """Show the part of the plane where something happens, as a square."""
    radius = scene.task.reach_radius
    points = np.array(scene.waypoints)
    parts = [points - radius, points + radius, *(outline(o) for o in scene.obstacles)]
    parts += [record.executed.positions[:, :2] for record in records]
    seen = np.concatenate(parts)
    low, high = seen.min(axis=0), seen.max(axis=0)
    half = min(float((high - low).max()) / 2.0 + 0.015, 1.05 * EDGE)
    centre = np.clip((low + high) / 2.0, half - 1.05 * EDGE, 1.05 * EDGE - half)
    axes.set_xlim(centre[0] - half, centre[0] + half)
    axes.set_ylim(centre[1] - half, centre[1] + half)
    axes.set_aspect('equal')
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MultipleLocator(0.1))
        axis.set_major_formatter('{x:.1f} m')
