# SPDX-License-Identifier: Apache-2.0
"""Shortest ways on a grid over the workspace, by A*."""

from heapq import heappop, heappush
from itertools import product
from math import inf, sqrt

import numpy as np
from numpy.typing import NDArray

from srnn_config.scene import EDGE

CELL = 0.01
"""Edge of a cell [m]."""

SIDE = round(2 * EDGE / CELL) + 1

Cell = tuple[int, int]

_STEPS = [
    (dx, dy, float(np.hypot(dx, dy))) for dx, dy in product((-1, 0, 1), repeat=2) if dx or dy
]


def centres() -> NDArray[np.float64]:
    """Return the centres (SIDE * SIDE, 2) of all cells [m], row by row of x."""
    axis = np.linspace(-EDGE, EDGE, SIDE)
    return np.array(list(product(axis, axis)))


def cell_of(point: NDArray[np.float64]) -> Cell:
    """Return the cell that holds a point (2,) [m]."""
    x, y = np.clip(np.round((point + EDGE) / CELL), 0, SIDE - 1).astype(int).tolist()
    return x, y


def route(
    free: NDArray[np.bool_],
    start: NDArray[np.float64],
    goal: NDArray[np.float64],
    toll: float = inf,
) -> NDArray[np.float64] | None:
    """Return the shortest way between two points over free cells.

    Args:
        free: (SIDE, SIDE) cells that may be entered.
        start: (2,) [m].
        goal: (2,) [m]; its cell may be entered in any case.
        toll: added to the length of a step into a cell that is not free [cells].

    Returns:
        (n, 2) points [m] from start to goal, None if there is no way.

    """
    first, last = cell_of(start), cell_of(goal)
    cost = {first: 0.0}
    came_from: dict[Cell, Cell] = {}
    done: set[Cell] = set()
    queue = [(0.0, first)]
    while queue:
        _, cell = heappop(queue)
        if cell == last:
            return _way_back(came_from, cell, start, goal)
        if cell in done:
            continue
        done.add(cell)
        for neighbour, length in _neighbours(free, cell, last, toll):
            total = cost[cell] + length
            if total < cost.get(neighbour, inf):
                cost[neighbour] = total
                came_from[neighbour] = cell
                heappush(queue, (total + _beeline(neighbour, last), neighbour))
    return None


def _neighbours(
    free: NDArray[np.bool_], cell: Cell, goal: Cell, toll: float
) -> list[tuple[Cell, float]]:
    x, y = cell
    found = []
    for dx, dy, length in _STEPS:
        i, j = x + dx, y + dy
        if not (0 <= i < SIDE and 0 <= j < SIDE):
            continue
        # A diagonal step must not cut the corner of a cell that may not be entered.
        allowed = (free[i, j] and free[x, j] and free[i, y]) or (i, j) == goal
        if allowed or toll < inf:
            found.append(((i, j), length if allowed else length + toll))
    return found


def _beeline(a: Cell, b: Cell) -> float:
    dx, dy = abs(a[0] - b[0]), abs(a[1] - b[1])
    return max(dx, dy) + (sqrt(2.0) - 1.0) * min(dx, dy)


def _way_back(
    came_from: dict[Cell, Cell], cell: Cell, start: NDArray[np.float64], goal: NDArray[np.float64]
) -> NDArray[np.float64]:
    cells = [cell]
    while cells[-1] in came_from:
        cells.append(came_from[cells[-1]])
    inner = np.array(cells[::-1][1:-1], dtype=np.float64).reshape(-1, 2) * CELL - EDGE
    return np.vstack([start, inner, goal])
