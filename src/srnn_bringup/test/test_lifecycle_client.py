# SPDX-License-Identifier: Apache-2.0
from types import SimpleNamespace

from lifecycle_msgs.msg import State
from lifecycle_msgs.srv import ChangeState, GetState
import pytest

from srnn_bringup import lifecycle_client
from srnn_bringup.errors import BringupError, Interrupted, NotReadyError, TransitionError
from srnn_bringup.lifecycle_client import LifecycleClient
from srnn_bringup.live_graph import last_error
from srnn_bringup.pump import Pump


class Service:
    """Stands for a service of a node; answers at once, or never."""

    def __init__(self, ready=True, answer=None):
        self.ready = ready
        self.answer = answer
        self.requests = []

    def service_is_ready(self):
        return self.ready

    def call_async(self, request):
        self.requests.append(request)
        return SimpleNamespace(
            done=lambda: self.answer is not None, result=lambda: self.answer
        )

    def remove_pending_request(self, future):
        self.requests.append('removed')


class Managed:
    """Stands for a managed node, and for the node that creates its clients."""

    def __init__(self, ready=True, success=None, state=None):
        answer = None if success is None else SimpleNamespace(success=success)
        known = None if state is None else SimpleNamespace(current_state=State(id=state))
        self.change = Service(ready, answer)
        self.state = Service(ready, known)
        self.services = {}

    def create_client(self, kind, name):
        client = {ChangeState: self.change, GetState: self.state}[kind]
        self.services[name] = client
        return client


class Idle:
    def spin_once(self, timeout_sec=None):
        pass


def change(node, reason='', guard=lambda: None):
    client = LifecycleClient(node, 'planner', lambda: reason)
    client.change('configure', Pump(Idle(), guard), 0.01)


def test_a_transition_is_requested_from_the_right_node():
    node = Managed(success=True)
    change(node)
    assert set(node.services) == {'planner/change_state', 'planner/get_state'}
    assert [r.transition.id for r in node.change.requests] == [1]
    assert not node.state.requests


def test_a_transition_whose_answer_was_lost_has_happened_all_the_same():
    node = Managed(state=State.PRIMARY_STATE_INACTIVE)
    change(node)
    assert [node.change.requests[0].transition.id, *node.change.requests[1:]] == [1, 'removed']


def test_a_refusal_names_node_transition_and_reason():
    with pytest.raises(TransitionError) as caught:
        change(Managed(success=False), 'no such scene')
    assert str(caught.value) == 'planner refuses to configure: no such scene'


@pytest.mark.parametrize('state', [None, State.PRIMARY_STATE_UNCONFIGURED])
def test_waiting_for_an_answer_ends(state):
    node = Managed(state=state)
    with pytest.raises(NotReadyError, match='planner does not configure within'):
        change(node)
    assert node.change.requests[1:] == ['removed']


def test_waiting_for_a_node_ends(monkeypatch):
    monkeypatch.setattr(lifecycle_client, 'DISCOVERY_S', 0.01)
    with pytest.raises(NotReadyError, match='planner cannot be reached') as caught:
        change(Managed(ready=False))
    assert isinstance(caught.value, TimeoutError)
    assert isinstance(caught.value, BringupError)


def test_the_user_can_interrupt_every_wait():
    def guard():
        raise Interrupted('SIGINT')

    with pytest.raises(Interrupted):
        change(Managed(), guard=guard)
    with pytest.raises(Interrupted):
        change(Managed(ready=False), guard=guard)


def test_an_unguarded_pump_goes_on_in_any_case():
    def guard():
        raise Interrupted('SIGINT')

    Pump(Idle(), guard).unguarded().turn()


def test_the_reason_is_the_last_error_that_was_logged():
    lines = (
        '[ERROR] [1732262390.1] [planner]: configure: first',
        '[INFO] [1732262390.2] [planner]: all is well',
        '[ERROR] [1732262390.3] [planner]: configure: the scene: has no way points',
        'something else',
    )
    assert last_error(lines) == 'configure: the scene: has no way points'
    assert last_error(('nothing', 'here')) == ''
