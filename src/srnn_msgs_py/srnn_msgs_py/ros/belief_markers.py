# SPDX-License-Identifier: Apache-2.0
"""What the network has learned to avoid, as columns in visualization_msgs/MarkerArray."""

from geometry_msgs.msg import Point, Vector3
import numpy as np
from numpy.typing import NDArray
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from srnn_msgs_py.ros.points import pose_at
from srnn_msgs_py.ros.stamp import stamp_to_msg
from srnn_msgs_py.segment import FRAME

TALLEST = 0.08
"""Height of the column where most was learned [m]."""

LEAST = 0.01
"""Neurons whose inhibition is a smaller share of the largest have no column."""


def to_msg(inhibition: NDArray[np.float64], half_extent: float, stamp_ns: int) -> MarkerArray:
    """Return a column for every neuron whose input was inhibited, the taller the more.

    Args:
        inhibition: (n, n) for neurons [x, y] of the grid, >= 0.
        half_extent: the outermost neurons sit this far from the centre [m].
        stamp_ns: time of the belief [ns].

    """
    side = np.linspace(-half_extent, half_extent, len(inhibition))
    width = 0.8 * float(side[1] - side[0])
    share = inhibition / max(float(inhibition.max()), 1e-9)
    # Whatever was shown before and is not shown now must go.
    markers = [Marker(header=_header(stamp_ns), ns='belief', action=Marker.DELETEALL)]
    for index, (x, y) in enumerate(np.argwhere(share > LEAST).tolist()):
        height = TALLEST * float(share[x, y])
        marker = Marker(
            header=_header(stamp_ns),
            ns='belief',
            id=index,
            type=Marker.CUBE,
            action=Marker.ADD,
            pose=pose_at((side[x], side[y])),
            scale=Vector3(x=width, y=width, z=height),
            color=ColorRGBA(r=0.1, g=0.3, b=0.7, a=0.2 + 0.6 * float(share[x, y])),
        )
        position: Point = marker.pose.position
        position.z = height / 2.0
        markers.append(marker)
    return MarkerArray(markers=markers)


def _header(stamp_ns: int) -> Header:
    return Header(stamp=stamp_to_msg(stamp_ns), frame_id=FRAME)
