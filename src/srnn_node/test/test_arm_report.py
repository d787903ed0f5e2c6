# SPDX-License-Identifier: Apache-2.0
"""What an arm tells comes in an order that its listeners can act on."""

import numpy as np

from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.ros import joints, wrench
from srnn_node.arm_report import CYCLES_PER_WRENCH, ArmReport

NAMES = ('a', 'b')


class Advertising:
    """Stands in for a node; every publisher writes into one list."""

    def __init__(self):
        self.said = []

    def advertise(self, name):
        return type('', (), {'publish': lambda _, msg: self.said.append((name, msg))})()


def sample(stamp_ns):
    return JointSample(stamp_ns, *np.arange(8.0).reshape(4, 2))


def test_the_torque_goes_before_the_state_that_it_belongs_to():
    node = Advertising()
    ArmReport(node, NAMES, lambda q, external: np.zeros(3)).publish(sample(7))
    (first, external), (second, measured) = node.said
    assert (first, second) == ('external_torque/joint_states', 'joint_states')
    heard = joints.from_msgs(measured, external, NAMES, 0.0)
    assert heard.stamp_ns == 7
    np.testing.assert_array_equal(heard.external_torque, [6.0, 7.0])


def test_the_force_of_the_last_measurement_goes_with_every_few_of_them():
    node = Advertising()
    report = ArmReport(node, NAMES, lambda q, external: np.array([*q, external[1]]))
    told = [report.publish(sample(stamp)) for stamp in range(1, 3 * CYCLES_PER_WRENCH + 1)]
    forces = [wrench.from_msg(msg) for name, msg in node.said if name == 'wrench']
    stamps = [stamp for stamp, went in enumerate(told, 1) if went]
    assert stamps == [force.stamp_ns for force in forces]
    assert stamps == [CYCLES_PER_WRENCH * n for n in (1, 2, 3)]
    np.testing.assert_array_equal(forces[0].force, [0.0, 1.0, 7.0])
