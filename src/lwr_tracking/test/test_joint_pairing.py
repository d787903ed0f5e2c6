# SPDX-License-Identifier: Apache-2.0
"""A joint state is a measurement only together with the torque of the same time."""

from dataclasses import replace

import numpy as np
from perfect_arm import PerfectArm
import pytest

from lwr_description import JOINT_NAMES
from lwr_tracking.joint_pairing import MAX_LAG, JointPairing
from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros import joints

SAMPLE = replace(PerfectArm().sample(), stamp_ns=10**9, external_torque=np.arange(7.0))
MEASURED, _ = joints.to_msgs(SAMPLE, JOINT_NAMES)


def external(later_s=0.0, torque=SAMPLE.external_torque):
    stamp_ns = SAMPLE.stamp_ns + round(1e9 * later_s)
    sample = replace(SAMPLE, stamp_ns=stamp_ns, external_torque=torque)
    return joints.to_msgs(sample, JOINT_NAMES)[1]


def test_without_a_torque_there_is_no_measurement():
    with pytest.raises(MessageError, match='no external torque yet'):
        JointPairing(JOINT_NAMES).pair(MEASURED)


@pytest.mark.parametrize('later', [-MAX_LAG, 0.0, MAX_LAG])
def test_the_newest_torque_belongs_to_a_joint_state(later):
    pairing = JointPairing(JOINT_NAMES)
    pairing.keep(external(torque=np.zeros(7)))
    pairing.keep(external(later))
    found = pairing.pair(MEASURED)
    np.testing.assert_array_equal(found.position, SAMPLE.position)
    np.testing.assert_array_equal(found.external_torque, SAMPLE.external_torque)
    assert found.lag_ns == round(1e9 * later)


@pytest.mark.parametrize('later', [-1.01 * MAX_LAG, 1.01 * MAX_LAG])
def test_a_torque_of_another_time_does_not(later):
    pairing = JointPairing(JOINT_NAMES)
    pairing.keep(external(later))
    with pytest.raises(MessageError, match='from the joint state'):
        pairing.pair(MEASURED)
