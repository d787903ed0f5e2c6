# SPDX-License-Identifier: Apache-2.0
"""A service says what was done, or why it was not; what nobody expects is no answer."""

import pytest
from std_srvs.srv import Trigger

from srnn_node import trigger
from srnn_node.errors import NotNowError


class DiskError(Exception):
    """An error that is a refusal where it is named."""


class Offering:
    """Stands in for a node."""

    def create_service(self, kind, name, answer):
        assert kind is Trigger
        self.name, self.answer = name, answer


def asked(action, *errors):
    node = Offering()
    trigger.offer(node, 'save', action, *errors)
    assert node.name == '~/save'
    response = node.answer(Trigger.Request(), Trigger.Response())
    return response.success, response.message


def failing(error):
    def action():
        raise error

    return action


def test_what_was_done_is_told():
    assert asked(lambda: 'saved') == (True, 'saved')


def test_a_refusal_is_told_with_its_reason():
    assert asked(failing(NotNowError('asleep'))) == (False, 'asleep')
    assert asked(failing(DiskError('full')), DiskError) == (False, 'full')


def test_an_error_that_is_no_refusal_is_not_hidden():
    with pytest.raises(DiskError):
        asked(failing(DiskError('full')))


def test_a_client_is_answered(bench):
    node, client = bench.client('keeper'), bench.client()
    trigger.offer(node, 'save', lambda: 'saved')
    answer = bench.call(client, Trigger, 'keeper/save', Trigger.Request())
    assert (answer.success, answer.message) == (True, 'saved')
