# SPDX-License-Identifier: Apache-2.0
"""Who may not send is dropped first, what cannot be converted is counted, the rest is heard."""

import pytest

from srnn_access import Refusal
from srnn_msgs_py.errors import MessageError
from srnn_node.reception import Reception


class Judge:
    """Stands in for an inlet: says of every message what it is told to say."""

    verdict = None

    def judge(self, msg, now, wall_ns):
        return self.verdict


class Listener:
    def __init__(self, waits=True):
        self.judge, self.heard, self.foreign, self.unconverted = Judge(), [], [], 0
        self.reception = Reception(
            self.judge, self.convert, self.heard.append, self.foreign.append if waits else None,
            self.count,
        )  # fmt: skip

    def convert(self, msg):
        if msg < 0:
            raise MessageError('negative')
        return 10 * msg

    def count(self):
        self.unconverted += 1

    def gets(self, msg, verdict=None):
        self.judge.verdict = verdict
        self.reception.receive(msg)


def test_what_may_be_sent_is_converted_and_heard():
    listener = Listener()
    for msg in (1, -1, 2):
        listener.gets(msg)
    assert (listener.heard, listener.unconverted) == ([10, 20], 1)


@pytest.mark.parametrize('refusal', [r for r in Refusal if r is not Refusal.NOT_OWNER])
def test_what_may_not_be_sent_is_not_even_converted(refusal):
    listener = Listener()
    listener.gets(-1, refusal)
    listener.gets(1, refusal)
    assert (listener.heard, listener.foreign, listener.unconverted) == ([], [], 0)


def test_a_sender_who_is_not_in_charge_is_heard_elsewhere_if_anywhere():
    listener, deaf = Listener(), Listener(waits=False)
    for one in (listener, deaf):
        one.gets(1, Refusal.NOT_OWNER)
        one.gets(-1, Refusal.NOT_OWNER)
    assert (listener.heard, listener.foreign, listener.unconverted) == ([], [10], 1)
    assert (deaf.heard, deaf.foreign, deaf.unconverted) == ([], [], 0)
