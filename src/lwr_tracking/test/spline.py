# SPDX-License-Identifier: Apache-2.0
"""A cubic spline through points, twice continuously differentiable."""

import numpy as np


class Spline:
    """Natural at its ends, or periodic; from the second derivatives at its knots."""

    def __init__(self, x: np.ndarray, points: np.ndarray, periodic: bool = False) -> None:
        self.x = np.asarray(x, dtype=float)
        self._y = np.asarray(points, dtype=float)
        count, h = len(self.x), np.diff(self.x)
        slope = np.diff(self._y, axis=0) / h[:, None]
        system, right = np.eye(count), np.zeros_like(self._y)
        for i in range(1, count - 1):
            system[i, i - 1 : i + 2] = h[i - 1], 2.0 * (h[i - 1] + h[i]), h[i]
            right[i] = 6.0 * (slope[i] - slope[i - 1])
        if periodic:
            system[0, -1] = -1.0
            system[-1, :2] = 2.0 * h[0], h[0]
            system[-1, -2:] += h[-1], 2.0 * h[-1] - 1.0
            right[-1] = 6.0 * (slope[0] - slope[-1])
        self._bend = np.linalg.solve(system, right)

    def __call__(self, s: np.ndarray, order: int = 0) -> np.ndarray:
        s = np.asarray(s, dtype=float)
        i = np.clip(np.searchsorted(self.x, s, side='right') - 1, 0, len(self.x) - 2)
        h = (self.x[i + 1] - self.x[i])[..., None]
        b = (s - self.x[i])[..., None]
        a = h - b
        y0, y1, m0, m1 = self._y[i], self._y[i + 1], self._bend[i], self._bend[i + 1]
        if order == 2:
            return (a * m0 + b * m1) / h
        if order == 1:
            return (y1 - y0) / h + (b**2 * m1 - a**2 * m0) / (2.0 * h) - h * (m1 - m0) / 6.0
        cubic = (a**3 * m0 + b**3 * m1) / (6.0 * h)
        return cubic + (y0 / h - h * m0 / 6.0) * a + (y1 / h - h * m1 / 6.0) * b
