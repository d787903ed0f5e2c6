# SPDX-License-Identifier: Apache-2.0
import time
from types import SimpleNamespace

from lifecycle_msgs.msg import State, TransitionEvent
import pytest

from srnn_bringup.paused_nodes import PausedNodes

CONFIGURED = (State.TRANSITION_STATE_CONFIGURING, State.PRIMARY_STATE_INACTIVE)
ACTIVATED = (State.TRANSITION_STATE_ACTIVATING, State.PRIMARY_STATE_ACTIVE)
DEACTIVATING = (State.PRIMARY_STATE_ACTIVE, State.TRANSITION_STATE_DEACTIVATING)
DEACTIVATED = (State.TRANSITION_STATE_DEACTIVATING, State.PRIMARY_STATE_INACTIVE)


def told():
    """Return pauses, and what a planner tells of itself."""
    listeners = {}
    node = SimpleNamespace(
        create_subscription=lambda _, name, take, depth: listeners.setdefault(name, take)
    )
    pauses = PausedNodes(node, ['tracker', 'planner'])

    def planner(start, goal):
        event = TransitionEvent(start_state=State(id=start), goal_state=State(id=goal))
        listeners['planner/transition_event'](event)

    return pauses, planner


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
    pauses, planner = told()
    for transition in transitions:
        planner(*transition)
    assert pauses.paused == ({'planner'} if paused else set())


@pytest.mark.parametrize(('later', 'paused'), [(0.5, set()), (60.0, {'planner'})])
def test_a_node_that_ends_itself_has_not_been_paused_but_one_that_was_stays_so(
    monkeypatch, later, paused
):
    now = time.monotonic()
    monkeypatch.setattr(time, 'monotonic', lambda: now)
    pauses, planner = told()
    for transition in (ACTIVATED, DEACTIVATING, DEACTIVATED):
        planner(*transition)
    monkeypatch.setattr(time, 'monotonic', lambda: now + later)
    pauses.ended_itself('planner')
    assert pauses.paused == paused
