# SPDX-License-Identifier: Apache-2.0
from types import SimpleNamespace

from lifecycle_msgs.msg import State, TransitionEvent
import pytest

from srnn_bringup.states import States

CONFIGURED = (State.TRANSITION_STATE_CONFIGURING, State.PRIMARY_STATE_INACTIVE)
ACTIVATED = (State.TRANSITION_STATE_ACTIVATING, State.PRIMARY_STATE_ACTIVE)
DEACTIVATING = (State.PRIMARY_STATE_ACTIVE, State.TRANSITION_STATE_DEACTIVATING)
DEACTIVATED = (State.TRANSITION_STATE_DEACTIVATING, State.PRIMARY_STATE_INACTIVE)


@pytest.mark.parametrize(
    ('transitions', 'paused'),
    [
        ([], False),
        ([CONFIGURED], False),
        ([CONFIGURED, ACTIVATED], False),
        ([CONFIGURED, ACTIVATED, DEACTIVATING, DEACTIVATED], True),
        ([ACTIVATED, DEACTIVATING, DEACTIVATED, CONFIGURED], True),
        ([ACTIVATED, DEACTIVATING, DEACTIVATED, ACTIVATED], False),
    ],
)
def test_a_node_is_paused_from_deactivation_to_activation_even_if_it_dies_between(
    transitions, paused
):
    listeners = {}
    node = SimpleNamespace(
        create_subscription=lambda _, name, take, depth: listeners.setdefault(name, take)
    )
    states = States(node, ['tracker', 'planner'])
    for start, goal in transitions:
        event = TransitionEvent(start_state=State(id=start), goal_state=State(id=goal))
        listeners['planner/transition_event'](event)
    assert states.paused == ({'planner'} if paused else set())
