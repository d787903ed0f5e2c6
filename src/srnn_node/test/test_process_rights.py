# SPDX-License-Identifier: Apache-2.0
import gc
import os
import signal
import subprocess
import sys

import pytest

from srnn_node import garbage
from srnn_node.errors import NodeError
from srnn_node.realtime import VARIABLE, Scheduling, request_realtime
from srnn_node.signals import StopRequest

ASK = """
import os
from srnn_node.realtime import request_realtime
got = request_realtime(5)
print(got.granted, os.sched_getscheduler(0) == os.SCHED_FIFO, got.words)
"""


FOR_A_WHILE = """
import os, threading
from srnn_node.realtime import request_realtime, unhurried
request_realtime(5)
told, asked, answered = [], threading.Event(), threading.Event()

def other():
    asked.wait()
    told.append(os.sched_getscheduler(0))
    answered.set()

thread = threading.Thread(target=other)
thread.start()
before = os.sched_getscheduler(0), os.sched_getparam(0).sched_priority
try:
    with unhurried():
        during = os.sched_getscheduler(0)
        asked.set()
        answered.wait()
        raise KeyError
except KeyError:
    after = os.sched_getscheduler(0), os.sched_getparam(0).sched_priority
print(before == after, during == os.SCHED_OTHER, told[0] == before[0])
"""


@pytest.mark.parametrize('environ', [{}, {VARIABLE: ''}, {VARIABLE: '0'}])
def test_nobody_who_does_not_ask_is_given_priority(environ):
    policy = os.sched_getscheduler(0)
    assert request_realtime(0, environ) == Scheduling(True, 'normal scheduling')
    assert os.sched_getscheduler(0) == policy


@pytest.mark.parametrize('text', ['100', '-1', 'high', '1.5', '²'])
def test_impossible_priorities_are_refused_by_name(text):
    with pytest.raises(NodeError, match=rf'{VARIABLE} = .*: must be 1 to 99, or 0') as caught:
        request_realtime(0, {VARIABLE: text})
    assert isinstance(caught.value, ValueError)


def test_what_is_told_is_what_the_kernel_did():
    done = subprocess.run(
        [sys.executable, '-c', ASK], capture_output=True, text=True, timeout=30, check=True
    )
    granted, fifo, words = done.stdout.strip().split(' ', 2)
    assert words.startswith('SCHED_FIFO 5') == (fifo == 'True')
    assert granted == str(words == 'SCHED_FIFO 5, memory locked')


def test_who_takes_long_lets_others_go_first_and_is_as_fast_as_before_afterwards():
    done = subprocess.run(
        [sys.executable, '-c', FOR_A_WHILE], capture_output=True, text=True, timeout=30, check=True
    )
    assert done.stdout.split() == ['True', 'True', 'True']


def test_a_frozen_collector_leaves_everything_alone_until_it_is_thawed():
    garbage.freeze()
    try:
        assert not gc.isenabled()
        assert gc.get_freeze_count() > 0
    finally:
        garbage.thaw()
    assert gc.isenabled()
    assert gc.get_freeze_count() == 0


def test_the_first_signal_is_recorded_and_the_handlers_come_back():
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    with StopRequest() as stop:
        assert stop.name is None
        os.kill(os.getpid(), signal.SIGTERM)
        os.kill(os.getpid(), signal.SIGINT)
        assert stop.name == 'SIGTERM'
    assert before == {number: signal.getsignal(number) for number in before}
