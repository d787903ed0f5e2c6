# SPDX-License-Identifier: Apache-2.0
"""What is drawn in the plane: obstacles, way points, and what neurons have learned."""

from collections.abc import Iterable, Sequence

from matplotlib.axes import Axes
from matplotlib.image import AxesImage
from matplotlib.patches import Circle, Polygon
from matplotlib.ticker import MultipleLocator
import numpy as np
from numpy.typing import ArrayLike, NDArray

from srnn_bringup.plots.style import INK, NEURON, REACH
from srnn_config.scene import EDGE

NEURON_AREA = 130.0
"""Area of the neuron whose output changed most [square points]."""


def draw_obstacles(axes: Axes, outlines: Iterable[ArrayLike], colour: str) -> None:
    """Draw obstacles by their outlines (n, 2) [m]; colour ``none`` shows what is below."""
    for corners in outlines:
        axes.add_patch(Polygon(np.asarray(corners), fc=colour, ec=INK, lw=1.8, zorder=4.5))


def draw_waypoints(axes: Axes, points: Sequence[ArrayLike], radius: float) -> None:
    """Draw numbered way points (2,) and within what radius they count as reached [m]."""
    for number, point in enumerate(points, start=1):
        x, y = np.asarray(point, dtype=np.float64)
        axes.add_patch(Circle((x, y), radius, fill=False, ec=REACH, lw=1.2, ls=(0, (4, 3))))
        axes.plot(x, y, 'o', ms=17, mfc='white', mec=INK, mew=1.5, zorder=6)
        axes.annotate(
            str(number), (x, y), ha='center', va='center_baseline', fontsize=11, zorder=7
        )


def draw_change(
    axes: Axes,
    neurons: NDArray[np.float64],
    received: NDArray[np.float64],
    sent: NDArray[np.float64],
    received_limit: float | None = None,
    sent_limit: float | None = None,
) -> AxesImage:
    """Draw what has changed in a network.

    Args:
        axes: where to draw.
        neurons: (K, 2) positions of the neurons on their grid [m].
        received: (K,) average change of synaptic input, shown as colour.
        sent: (K,) average change of synaptic output, shown as size.
        received_limit: change of input at the ends of the scale; the largest by default.
        sent_limit: change of output of the largest circles; the largest by default.

    """
    side = round(len(neurons) ** 0.5)
    edge = float(neurons.max()) * side / (side - 1)
    limit = received_limit or float(np.abs(received).max()) or 1.0
    image = axes.imshow(
        received.reshape(side, side).T, origin='lower', extent=(-edge, edge, -edge, edge),
        cmap='RdBu_r', vmin=-limit, vmax=limit, interpolation='hermite',
    )  # fmt: skip
    size = np.abs(sent) / (sent_limit or float(np.abs(sent).max()) or 1.0)
    x, y = neurons.T
    area = 4.0 + NEURON_AREA * size
    axes.scatter(x, y, s=area, color='white', ec=NEURON, lw=0.8, alpha=0.9, zorder=4)
    return image


def show_square(axes: Axes, seen: Sequence[ArrayLike]) -> None:
    """Show the part of the plane where something is, points (n, 2) [m], as a square."""
    points = np.concatenate([np.asarray(part, dtype=np.float64) for part in seen])
    low, high = points.min(axis=0), points.max(axis=0)
    half = min(float((high - low).max()) / 2.0 + 0.015, 1.05 * EDGE)
    centre = np.clip((low + high) / 2.0, half - 1.05 * EDGE, 1.05 * EDGE - half)
    axes.set_xlim(centre[0] - half, centre[0] + half)
    axes.set_ylim(centre[1] - half, centre[1] + half)
    axes.set_aspect('equal')
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MultipleLocator(0.1))
        axis.set_major_formatter('{x:.1f} m')


def reach(points: Sequence[ArrayLike], radius: float) -> list[NDArray[np.float64]]:
    """Return corners of the squares around way points (2,) that their circles fill [m]."""
    centres = np.asarray(points, dtype=np.float64)
    return [centres - radius, centres + radius]
