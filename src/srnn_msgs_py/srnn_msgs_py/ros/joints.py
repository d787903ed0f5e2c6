# SPDX-License-Identifier: Apache-2.0
"""JointSample ↔ two sensor_msgs/JointState: measured, and external torques."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.ros.arrays import doubles, vector
from srnn_msgs_py.ros.stamp import SECOND_NS, stamp_from_msg, stamp_to_msg


def to_msgs(sample: JointSample, names: Sequence[str]) -> tuple[JointState, JointState]:
    """Return the measured state and the external torques, both with the sample's stamp.

    Args:
        sample: one measurement of the arm.
        names: joint names in the order of the sample.

    """
    measured = JointState(
        header=Header(stamp=stamp_to_msg(sample.stamp_ns)),
        name=list(names),
        position=doubles(sample.position),
        velocity=doubles(sample.velocity),
        effort=doubles(sample.torque),
    )
    external = JointState(
        header=Header(stamp=stamp_to_msg(sample.stamp_ns)),
        name=list(names),
        effort=doubles(sample.external_torque),
    )
    return measured, external


def from_msgs(
    measured: JointState, external: JointState, names: Sequence[str], max_lag_s: float
) -> JointSample:
    """Return one sample, stamped as the measured state.

    Args:
        measured: positions, velocities and torques.
        external: external torques.
        names: joint names in the order that the sample shall have; the messages may
            have another.
        max_lag_s: largest difference of the two stamps [s].

    Raises:
        MessageError: joints are missing or unknown, a field has the wrong length, a
            number is not finite, or the messages are too far apart in time.

    """
    stamp_ns = stamp_from_msg(measured.header.stamp)
    lag_ns = stamp_from_msg(external.header.stamp) - stamp_ns
    if abs(lag_ns) > max_lag_s * SECOND_NS:
        raise MessageError(
            f'external torque is {abs(lag_ns) / 1e6:.1f} ms from the joint state: '
            f'must be <= {max_lag_s * 1e3:.1f} ms'
        )
    return JointSample(
        stamp_ns=stamp_ns,
        position=_ordered(measured, 'position', names),
        velocity=_ordered(measured, 'velocity', names),
        torque=_ordered(measured, 'effort', names),
        external_torque=_ordered(external, 'effort', names),
        lag_ns=lag_ns,
    )


def positions(measured: JointState, names: Sequence[str]) -> NDArray[np.float64]:
    """Return the joint angles in the order of `names` [rad].

    Raises:
        MessageError: joints are missing or unknown, or a number is not finite.

    """
    return _ordered(measured, 'position', names)


def _ordered(msg: JointState, field: str, names: Sequence[str]) -> NDArray[np.float64]:
    values = vector(getattr(msg, field), len(names), field)
    if list(msg.name) == list(names):
        return values
    if sorted(msg.name) != sorted(names):
        raise MessageError(f'name = {list(msg.name)[:16]}: must be {", ".join(names)}')
    return values[[msg.name.index(name) for name in names]]
