# SPDX-License-Identifier: Apache-2.0
"""What the network has learned to avoid ↔ nav_msgs/OccupancyGrid, for display only."""

from array import array

from nav_msgs.msg import MapMetaData, OccupancyGrid
import numpy as np
from numpy.typing import NDArray
from std_msgs.msg import Header

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros.points import pose_at
from srnn_msgs_py.ros.stamp import stamp_to_msg
from srnn_msgs_py.segment import FRAME


def to_msg(inhibition: NDArray[np.float64], half_extent: float, stamp_ns: int) -> OccupancyGrid:
    """Return the learned inhibition as a map; 100 is the most inhibited cell.

    Args:
        inhibition: (n, n) for neurons [x, y] of the grid, >= 0.
        half_extent: the outermost neurons sit this far from the centre [m].
        stamp_ns: time of the map [ns].

    """
    count = len(inhibition)
    cell = 2.0 * half_extent / (count - 1)
    corner = -half_extent - cell / 2.0
    scaled = np.round(100.0 * inhibition / max(float(inhibition.max()), 1e-9))
    return OccupancyGrid(
        header=Header(stamp=stamp_to_msg(stamp_ns), frame_id=FRAME),
        info=MapMetaData(
            map_load_time=stamp_to_msg(stamp_ns),
            resolution=float(cell),
            width=count,
            height=count,
            origin=pose_at((corner, corner)),
        ),
        # Row-major from the corner with x running fastest.
        data=array('b', scaled.T.astype(np.int8).ravel().tolist()),
    )


def from_msg(msg: OccupancyGrid) -> tuple[NDArray[np.float64], tuple[float, float], float]:
    """Return a map: inhibition (rows, columns), rows upward, 0 to 1; its corner and cell [m].

    Raises:
        MessageError: it has not as many cells as it says.

    """
    shape = msg.info.height, msg.info.width
    if len(msg.data) != shape[0] * shape[1]:
        raise MessageError(f'data: {len(msg.data)} cells: must be {shape[0]} x {shape[1]}')
    corner = msg.info.origin.position
    inhibition = np.clip(np.array(msg.data, float) / 100.0, 0.0, 1.0).reshape(shape)
    return inhibition, (corner.x, corner.y), msg.info.resolution
