# SPDX-License-Identifier: Apache-2.0
"""The named qualities of service as rclpy profiles."""

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from srnn_msgs_py.qos import Qos


def profile(qos: Qos) -> QoSProfile:
    """Return the rclpy profile."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=qos.depth,
        reliability=ReliabilityPolicy.RELIABLE if qos.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if qos.latched else DurabilityPolicy.VOLATILE,
    )
