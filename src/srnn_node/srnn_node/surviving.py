# SPDX-License-Identifier: Apache-2.0
"""A managed node that survives transitions that are impossible."""

from typing import Any

from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.lifecycle import LifecycleNode


class SurvivingNode(LifecycleNode):  # type: ignore[misc]  # rclpy is not typed
    """Refuses what it cannot do in its state, and goes on.

    rclpy lets the error of an impossible transition out of the executor, where it ends the
    node: any client could stop the arm that way.
    """

    @property
    def state(self) -> str:
        """Label of the state: unconfigured, inactive, active or finalized."""
        return str(self._state_machine.current_state[1])

    def _LifecycleNodeMixin__on_change_state(self, request: Any, response: Any) -> Any:  # noqa: N802
        try:
            return super()._LifecycleNodeMixin__on_change_state(request, response)
        except rclpy_implementation.RCLError:
            asked = request.transition.label or request.transition.id
            self.get_logger().warning(f'transition {asked!r} is impossible while {self.state}')
            response.success = False
            return response
