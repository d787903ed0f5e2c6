# SPDX-License-Identifier: Apache-2.0
"""Everything that planning compiles, in NumPy: what it is compared with."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core import context, curve, graze, planner, selection, ways
from srnn_planner.core.sampling import PlainSampler
from srnn_planner.core.selection import pairwise_angles
from srnn_planner.core.shortest_way import relaxed
from srnn_planner.core.state_neurons import StateNeurons

Array = NDArray[np.float64]


class PlainMean:
    """Means on the grid by the plain reference."""

    def __init__(self, neurons: StateNeurons) -> None:
        """Take the grid."""
        self.at = neurons.interpolate


def nearest_directions(displacement: Array, count: int) -> NDArray[np.int64]:
    """Return the samples whose directions are nearest: see `core.nearest_directions`."""
    return np.argsort(pairwise_angles(displacement), axis=1, kind='stable')[:, :count]


def mode_means(paths: Array, modes: NDArray[np.int64]) -> Array:
    """Return the mean path of each mode: see `core.mode_means`."""
    return paths[modes].mean(axis=1)


def longest_steps(paths: Array) -> Array:
    """Return how far each path jumps: see `core.longest_step`."""
    return np.sqrt((np.diff(paths, axis=1) ** 2).sum(axis=2).max(axis=1))


def met(paths: Array, blocked: Array, caution: float) -> Array:
    """Return what paths meet: see `core.graze`."""
    travelled = np.linalg.norm(np.diff(paths, axis=1), axis=2)
    root = np.sqrt(blocked)
    return (travelled * root[:, 1:]).sum(axis=1) + caution * root.max(axis=1)


def generalized_error(
    centres: Array, neurons: Array, detour: Array, scale: float, exponent: float
) -> Array:
    """Return the pull of a way point: see `core.generalized_error`."""
    distance = np.linalg.norm(centres[:, None] - neurons, axis=2) + detour
    return np.exp(-((distance / scale) ** exponent))


def evenly(coefficients: Array, count: int) -> tuple[Array, float]:
    """Return points at even distances: see `core.arc_length`."""
    powers = np.linspace(0.0, 1.0, 4 * count)[:, None] ** np.arange(len(coefficients))
    line = powers @ coefficients
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    distance = np.concatenate([[0.0], np.cumsum(steps)])
    even = np.linspace(0.0, distance[-1], count)
    points = np.column_stack([np.interp(even, distance, column) for column in line.T])
    return points, float(distance[-1])


@contextmanager
def numpy_only() -> Iterator[None]:
    """Have planners that are built and used here plan without anything compiled."""
    compiled = [(module, name, getattr(module, name)) for module, name, _ in REPLACED]
    _put(REPLACED)
    try:
        yield
    finally:
        _put(compiled)


REPLACED = [
    (planner, 'Sampler', PlainSampler),
    (planner, 'longest_steps', longest_steps),
    (ways, 'distances', relaxed),
    (context, 'generalized_error', generalized_error),
    (selection, 'nearest_directions', nearest_directions),
    (selection, 'mode_means', mode_means),
    (graze, '_met', met),
    (curve, 'evenly', evenly),
]


def _put(functions: list[tuple[ModuleType, str, object]]) -> None:
    for module, name, function in functions:
        setattr(module, name, function)
