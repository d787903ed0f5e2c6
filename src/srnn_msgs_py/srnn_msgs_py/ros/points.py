# SPDX-License-Identifier: Apache-2.0
"""Points of three coordinates ↔ geometry_msgs/Point and Vector3."""

from collections.abc import Iterable

from geometry_msgs.msg import Point, Pose, Quaternion, Vector3
import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.errors import MessageError


def pose_at(position: Iterable[float]) -> Pose:
    """Return a pose with identity orientation at a point of 2 or 3 coordinates [m]."""
    x, y, z = (*(float(c) for c in position), 0.0)[:3]
    orientation = Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    return Pose(position=Point(x=x, y=y, z=z), orientation=orientation)


def vector_to_msg(values: NDArray[np.float64]) -> Vector3:
    """Return the message of a vector (3,)."""
    x, y, z = (float(c) for c in values)
    return Vector3(x=x, y=y, z=z)


def xyz(msg: Point | Vector3, field: str) -> list[float]:
    """Return the three coordinates of a point or vector.

    Raises:
        MessageError: a coordinate is not finite.

    """
    values = [float(msg.x), float(msg.y), float(msg.z)]
    if not np.isfinite(values).all():
        raise MessageError(f'{field} = {values}: must be finite')
    return values
