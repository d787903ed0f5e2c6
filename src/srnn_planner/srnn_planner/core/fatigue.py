# SPDX-License-Identifier: Apache-2.0
"""Where the arm has been for the sake of a way point, without getting there."""

import numpy as np
from numpy.typing import NDArray


class Fatigue:
    """Counts the visits to every neuron while one way point attracts.

    The ways to a way point and the synapses do not always agree: the bump of activity gets
    caught where a way leads on that it cannot follow. Visits make the ways from there
    longer, until another one is shorter, as real-time search fills up its dead ends (Korf
    1990, "Real-Time Heuristic Search"). Who gets on never comes back, and never tires.

    Attributes:
        visits: (K,) how often the arm was at each neuron, by its responsibilities.

    """

    def __init__(self, count: int) -> None:
        """Begin with so many rested neurons."""
        self.visits = np.zeros(count)
        self._target = b''

    def visit(
        self, responsibilities: NDArray[np.float64], target: NDArray[np.float64]
    ) -> None:
        """Count a visit, on the way to `target` (d,), to where these (K,) are responsible.

        Another target than before: all earlier visits are forgotten.
        """
        if target.tobytes() != self._target:
            self._target = target.tobytes()
            self.visits = np.zeros_like(self.visits)
        self.visits = self.visits + responsibilities
