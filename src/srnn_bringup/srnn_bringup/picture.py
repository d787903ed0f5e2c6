# SPDX-License-Identifier: Apache-2.0
"""One picture of a run: the path before and after learning, and what was learned."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Circle, Polygon
import numpy as np
from numpy.typing import NDArray

from srnn_bringup.config import Configuration
from srnn_bringup.outline import outline
from srnn_bringup.recorder import SegmentRecord
from srnn_config.scene import EDGE, Scene
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synaptic_change import input_change, output_change

SIZE = (12.0, 7.6)
"""Width and height [inch]."""

DPI = 150

BEFORE, AFTER, TOUCH, INK = '#e08e45', '#1f6f8b', '#c1121f', '#2b2d42'
OBSTACLE, REACH = '#8d99ae', '#adb5bd'
NEURON_AREA = 170.0
"""Area of the neuron whose output changed most [square points]."""

_STYLE: Any = {
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
    with rc_context(_STYLE):
        figure = Figure(figsize=SIZE, dpi=DPI, layout='constrained')
        grid = figure.add_gridspec(2, 2, height_ratios=[4.6, 1.0])
        left = figure.add_subplot(grid[0, 0])
        right = figure.add_subplot(grid[0, 1], sharex=left, sharey=left)
        _draw_paths(left, story)
        image = _draw_change(right, story)
        figure.colorbar(image, ax=right, shrink=0.9, label='average change of synaptic input')
        _draw_signal(figure.add_subplot(grid[1, :]), story)
        figure.savefig(path)


def _draw_paths(axes: Axes, story: Story) -> None:
    last = story.learned_until
    labels = {
        BEFORE: f'until the last update (segments 1 to {last})', AFTER: 'from then on'
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
    _draw_obstacles(axes, story.scene, OBSTACLE)
    _draw_waypoints(axes, story.scene)
    axes.set_title('The way round, learned by touch')
    if story.records:
        axes.legend(
            loc='upper center', bbox_to_anchor=(0.5, -0.13), ncols=3, frameon=False,
            fontsize=11, handlelength=1.6, columnspacing=1.4,
        )  # fmt: skip
    _frame(axes, story)


def _draw_waypoints(axes: Axes, scene: Scene) -> None:
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
        cmap='RdBu_r', vmin=-limit, vmax=limit, interpolation='bicubic',
    )  # fmt: skip
    area = 4.0 + NEURON_AREA * sent / (float(sent.max()) or 1.0)
    neurons = extent * StateNeurons(network).positions
    x, y = neurons.T
    axes.scatter(x, y, s=area, color='white', ec=INK, lw=0.7, alpha=0.85, zorder=4)
    _draw_obstacles(axes, story.scene, 'none')
    axes.set_title('What the network has learned to avoid')
    axes.set_xlabel('size of a neuron: average change of what it sends')
    _frame(axes, story)
    return image


def _draw_obstacles(axes: Axes, scene: Scene, colour: str) -> None:
    for obstacle in scene.obstacles:
        axes.add_patch(Polygon(outline(obstacle), fc=colour, ec=INK, lw=1.8, zorder=4.5))


def _draw_signal(axes: Axes, story: Story) -> None:
    lessons = [(record.number, record.lesson.peak) for record in story.records if record.lesson]
    numbers, peaks = np.array(lessons).T if lessons else np.zeros((2, 0))
    axes.bar(numbers, peaks, width=0.9, color=BEFORE)
    touches = [record.number for record in story.records if record.touched]
    axes.plot(touches, np.zeros(len(touches)), 'x', color=TOUCH, mew=2.2, ms=7, clip_on=False)
    count = len(story.records)
    axes.set_xlim(0.0, max(count, 10) + 1)
    axes.set_ylim(0.0, 1.15 * max(float(np.max(peaks, initial=0.0)), 0.05))
    axes.set_xlabel('segment')
    axes.set_ylabel('learning\nsignal')
    axes.spines[['top', 'right']].set_visible(False)


def _frame(axes: Axes, story: Story) -> None:
    """Show the part of the plane where something happens, as a square."""
    scene = story.scene
    radius = scene.task.reach_radius
    points = np.array(scene.waypoints)
    parts = [points - radius, points + radius, *(outline(o) for o in scene.obstacles)]
    parts += [record.executed.positions[:, :2] for record in story.records]
    seen = np.concatenate(parts)
    low, high = seen.min(axis=0), seen.max(axis=0)
    half = min(float((high - low).max()) / 2.0 + 0.015, 1.05 * EDGE)
    centre = np.clip((low + high) / 2.0, half - 1.05 * EDGE, 1.05 * EDGE - half)
    axes.set_xlim(centre[0] - half, centre[0] + half)
    axes.set_ylim(centre[1] - half, centre[1] + half)
    axes.set_aspect('equal')
    axes.set_xticks(_ticks(axes.get_xlim()), labels=[f'{v:.1f}' for v in _ticks(axes.get_xlim())])
    axes.set_yticks(_ticks(axes.get_ylim()), labels=[f'{v:.1f}' for v in _ticks(axes.get_ylim())])


def _ticks(limits: tuple[float, float]) -> list[float]:
    return [v / 10.0 for v in range(-3, 4) if limits[0] <= v / 10.0 <= limits[1]]
