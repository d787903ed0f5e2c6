# SPDX-License-Identifier: Apache-2.0
"""Way points ↔ visualization_msgs/MarkerArray, for display only."""

from geometry_msgs.msg import Vector3
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from srnn_msgs_py.ros.points import pose_at
from srnn_msgs_py.ros.stamp import stamp_to_msg
from srnn_msgs_py.waypoints import Waypoints

_ACTIVE = ColorRGBA(r=0.9, g=0.4, b=0.1, a=0.8)
_RESTING = ColorRGBA(r=0.2, g=0.4, b=0.8, a=0.5)


def to_msg(waypoints: Waypoints, active: int, reach_radius: float) -> MarkerArray:
    """Return a flat disc of the reach radius [m] for each way point, the active one in colour."""
    header = Header(stamp=stamp_to_msg(waypoints.stamp_ns), frame_id=str(waypoints.frame))
    diameter = 2.0 * float(reach_radius)
    markers = [
        Marker(
            header=header,
            ns='waypoints',
            id=index,
            type=Marker.CYLINDER,
            action=Marker.ADD,
            pose=pose_at(point),
            scale=Vector3(x=diameter, y=diameter, z=0.002),
            color=_ACTIVE if index == active else _RESTING,
        )
        for index, point in enumerate(waypoints.points)
    ]
    return MarkerArray(markers=markers)


def from_msg(msg: MarkerArray) -> list[tuple[tuple[float, float], float, bool]]:
    """Return where each way point is [m], the radius to be reached [m], and if it is next."""
    return [
        (
            (marker.pose.position.x, marker.pose.position.y), marker.scale.x / 2.0,
            marker.color.r > marker.color.b,
        )
        for marker in msg.markers
    ]  # fmt: skip
