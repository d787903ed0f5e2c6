# SPDX-License-Identifier: Apache-2.0
"""What an arm tells of itself, real or computed."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.ros import joints, wrench
from srnn_msgs_py.segment import FRAME
from srnn_msgs_py.wrench import Wrench
from srnn_node.lifecycle import WorkspaceNode

Array = NDArray[np.float64]

CYCLES_PER_WRENCH = 5
"""The wrench goes out for this many measurements: 50 Hz of 250 Hz."""


class ArmReport:
    """Joint states, external torques, and the force on the tip.

    Attributes:
        measured: publisher of the joint states.
        external: publisher of the external torques.

    """

    def __init__(
        self, node: WorkspaceNode, names: Sequence[str], tip_force: Callable[[Array, Array], Array]
    ) -> None:
        """Connect to the topics of `node`, which is being configured.

        Args:
            node: whose topics they are.
            names: of the joints.
            tip_force: returns the force (3,) [N] of angles (n,) [rad] and external torques
                (n,) [Nm].

        """
        self.measured = node.advertise('joint_states')
        self.external = node.advertise('external_torque/joint_states')
        self._wrench = node.advertise('wrench')
        self._names = names
        self._tip_force = tip_force
        self._cycles = 0

    def publish(self, sample: JointSample) -> bool:
        """Tell what was measured; return whether the force was told with it."""
        measured, external = joints.to_msgs(sample, self._names)
        # The tracker acts on the joint state, so the torque that belongs to it goes first.
        self.external.publish(external)
        self.measured.publish(measured)
        self._cycles += 1
        if self._cycles % CYCLES_PER_WRENCH:
            return False
        force = self._tip_force(sample.position, sample.external_torque)
        self._wrench.publish(wrench.to_msg(Wrench(sample.stamp_ns, FRAME, force, np.zeros(3))))
        return True
