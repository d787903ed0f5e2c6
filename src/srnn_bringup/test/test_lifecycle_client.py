# SPDX-License-Identifier: Apache-2.0
from types import SimpleNamespace

import pytest

from srnn_bringup import lifecycle_client
from srnn_bringup.errors import BringupError, Interrupted, NotReadyError, TransitionError
from srnn_bringup.lifecycle_client import LifecycleClient
from srnn_bringup.live_graph import last_error
from srnn_bringup.pump import Pump


class Service:
    """Stands for the service of a node, and for the node that creates its client."""

    def __init__(self, ready=True, answer=None):
        self.ready = ready
        self.answer = answer
        self.requests = []

    def create_client(self, kind, name):
        self.name = name
        return self

    def service_is_ready(self):
        return self.ready

    def call_async(self, request):
        self.requests.append(request.transition.id)
        return SimpleNamespace(
            done=lambda: self.answer is not None,
            result=lambda: SimpleNamespace(success=self.answer),
        )

    def remove_pending_request(self, future):
        self.requests.append('removed')


class Idle:
    def spin_once(self, timeout_sec=None):
        pass


def change(service, reason='', guard=lambda: None):
    client = LifecycleClient(service, 'planner', lambda: reason)
    client.change('configure', Pump(Idle(), guard), 0.01)


def test_a_transition_is_requested_from_the_right_node():
    service = Service(answer=True)
    change(service)
    assert service.name == 'planner/change_state'
    assert service.requests == [1]


def test_a_refusal_names_node_transition_and_reason():
    with pytest.raises(TransitionError) as caught:
        change(Service(answer=False), 'no such scene')
    assert str(caught.value) == 'planner refuses to configure: no such scene'


def test_waiting_for_an_answer_ends():
    service = Service()
    with pytest.raises(NotReadyError, match='planner does not configure within'):
        change(service)
    assert service.requests[-1] == 'removed'


def test_waiting_for_a_node_ends(monkeypatch):
    monkeypatch.setattr(lifecycle_client, 'DISCOVERY_S', 0.01)
    with pytest.raises(NotReadyError, match='planner cannot be reached') as caught:
        change(Service(ready=False))
    assert isinstance(caught.value, TimeoutError)
    assert isinstance(caught.value, BringupError)


def test_the_user_can_interrupt_every_wait():
    def guard():
        raise Interrupted('SIGINT')

    with pytest.raises(Interrupted):
        change(Service(), guard=guard)
    with pytest.raises(Interrupted):
        change(Service(ready=False), guard=guard)


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
