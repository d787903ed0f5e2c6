# SPDX-License-Identifier: Apache-2.0
"""Moves a managed node through its lifecycle from outside."""

from collections.abc import Callable
import time
from typing import Any

from lifecycle_msgs.msg import State, Transition
from lifecycle_msgs.srv import ChangeState, GetState
from rclpy.node import Node

from srnn_bringup.errors import NotReadyError, TransitionError
from srnn_bringup.pump import Pump

DISCOVERY_S = 20.0
"""Longest wait for a process to start and its services to be discovered [s]."""

ASK_AGAIN_S = 2.0
"""A node that has not answered by then is asked for its state [s]."""

_TRANSITIONS = {
    'configure': (Transition.TRANSITION_CONFIGURE, State.PRIMARY_STATE_INACTIVE),
    'activate': (Transition.TRANSITION_ACTIVATE, State.PRIMARY_STATE_ACTIVE),
    'deactivate': (Transition.TRANSITION_DEACTIVATE, State.PRIMARY_STATE_INACTIVE),
}
"""Transition and the state that it leads to."""


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
        self._change = node.create_client(ChangeState, f'{name}/change_state')
        self._state = node.create_client(GetState, f'{name}/get_state')

    def change(self, transition: str, pump: Pump, seconds: float) -> None:
        """Request a transition and wait for its end.

        The middleware may lose an answer to a client that the node has not discovered
        yet; therefore the state of a node that does not answer counts as well.

        Args:
            transition: configure, activate or deactivate.
            pump: handles events meanwhile.
            seconds: time that the transition itself may take [s].

        Raises:
            NotReadyError: the node is not there or does not answer in time.
            TransitionError: the node refuses, or its transition fails.

        """
        if not pump.until(self._ready, DISCOVERY_S):
            raise NotReadyError(f'{self.name} cannot be reached within {DISCOVERY_S:g} s')
        number, goal = _TRANSITIONS[transition]
        request = ChangeState.Request(transition=Transition(id=number))
        answer = self._change.call_async(request)
        end = time.monotonic() + seconds
        while not pump.until(answer.done, min(ASK_AGAIN_S, end - time.monotonic())):
            state = self._ask(pump, min(ASK_AGAIN_S, end - time.monotonic()))
            if state is not None and state.id == goal:
                self._change.remove_pending_request(answer)
                return
            if time.monotonic() >= end:
                self._change.remove_pending_request(answer)
                raise NotReadyError(f'{self.name} does not {transition} within {seconds:g} s')
        if not answer.result().success:
            reason = self._reason()
            why = f': {reason}' if reason else '; it is in another state'
            raise TransitionError(f'{self.name} refuses to {transition}{why}')

    def state(self, pump: Pump, seconds: float) -> str:
        """Return the label of the state of the node, asking again where an answer is lost.

        Args:
            pump: handles events meanwhile.
            seconds: longest wait [s].

        Raises:
            NotReadyError: the node is not there or does not answer in time.

        """
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0.0:
            if pump.until(self._ready, left):
                state = self._ask(pump, min(ASK_AGAIN_S, left))
                if state is not None:
                    return str(state.label)
        raise NotReadyError(f'{self.name} does not answer within {seconds:g} s')

    def _ready(self) -> bool:
        clients = (self._change, self._state)
        return all(client.service_is_ready() for client in clients)

    def _ask(self, pump: Pump, seconds: float) -> Any:
        """Return the state that the node says it is in, or None if it says nothing in time."""
        answer = self._state.call_async(GetState.Request())
        if pump.until(answer.done, seconds):
            return answer.result().current_state
        self._state.remove_pending_request(answer)
        return None
