# SPDX-License-Identifier: Apache-2.0
"""Which obstacle a contact was with."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from srnn_config.geometry import clearance
from srnn_config.scene import Obstacle


def attribute(
    points: NDArray[np.float64], groups: Sequence[Sequence[Obstacle]], reach: float
) -> list[int | None]:
    """Return for every contact the group of obstacles that it was with.

    That is the group with the obstacle nearest to the tip, the first of equally near ones.
    An arm that feels a contact although nothing is near touches no group.

    Args:
        points: (n, 2) measured tip at the contacts, in `srnn_workspace` [m].
        groups: obstacles that are told apart, for example the first and the new ones.
        reach: distance of the tip within which an obstacle can be touched [m].

    Returns:
        Index of the group for each of the n contacts; None for a contact with nothing.

    """
    distances = np.array([clearance(points, group) for group in groups])
    nearest = distances.argmin(axis=0)
    return [
        int(index) if distances[index, contact] <= reach else None
        for contact, index in enumerate(nearest)
    ]
