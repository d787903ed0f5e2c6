# SPDX-License-Identifier: Apache-2.0
"""Moves a managed node through its lifecycle from outside."""

from collections.abc import Callable
from typing import Any

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.node import Node

from srnn_bringup.errors import NotReadyError, TransitionError
from srnn_bringup.pump import Pump

DISCOVERY_S = 20.0
"""Longest wait for a process to start and its services to be discovered [s]."""

_TRANSITIONS = {
    'configure': Transition.TRANSITION_CONFIGURE,
    'activate': Transition.TRANSITION_ACTIVATE,
    'deactivate': Transition.TRANSITION_DEACTIVATE,
}


class LifecycleClient:
    """Asks one node for transitions and waits for its answers, never for ever."""

    def __init__(self, node: Node, name: str, reason: Callable[[], str]) -> None:
        """Talk to the node `name`.

        Args:
            node: node that the client belongs to.
            name: node to talk to.
            reason: returns why the last transition failed, empty if unknown.

        """
        self.name = name
        self._reason = reason
        self._client = node.create_client(ChangeState, f'{name}/change_state')

    def change(self, transition: str, pump: Pump, seconds: float) -> None:
        """Request a transition and wait for its end.

        Args:
            transition: configure, activate or deactivate.
            pump: handles events meanwhile.
            seconds: time that the transition itself may take [s].

        Raises:
            NotReadyError: the node is not there or does not answer in time.
            TransitionError: the node refuses, or its transition fails.

        """
        if not pump.until(self._client.service_is_ready, DISCOVERY_S):
            raise NotReadyError(f'{self.name} cannot be reached within {DISCOVERY_S:g} s')
        request = ChangeState.Request(transition=Transition(id=_TRANSITIONS[transition]))
        future: Any = self._client.call_async(request)
        if not pump.until(future.done, seconds):
            self._client.remove_pending_request(future)
            raise NotReadyError(f'{self.name} does not {transition} within {seconds:g} s')
        if not future.result().success:
            reason = self._reason()
            why = f': {reason}' if reason else '; it is in another state'
            raise TransitionError(f'{self.name} refuses to {transition}{why}')
