# SPDX-License-Identifier: Apache-2.0
"""The main loop with a clock that only the executor moves."""

import math

from srnn_node.loop import LONGEST_WAIT_S, Loop
from srnn_node.rate import RateKeeper


class FakeExecutor:
    """Sleeps by moving its clock; an event ends a wait early."""

    def __init__(self, event_every=math.inf, event_cost=0.0):
        self.now = 0.0
        self.waits = []
        self.events = 0
        self._every = event_every
        self._cost = event_cost
        self._next = event_every

    def spin_once(self, timeout_sec=None):
        self.waits.append(timeout_sec)
        if self._next <= self.now + timeout_sec:
            self.now = max(self.now, self._next) + self._cost
            self._next += self._every
            self.events += 1
        else:
            self.now += timeout_sec


class FakeNode:
    """Ticks at a period; a tick takes a while."""

    def __init__(self, executor, period, tick_cost=0.0, active=True):
        self.executor = executor
        self.active = active
        self.keeper = RateKeeper(period, 0.0)
        self.cost = tick_cost

    def seconds_to_tick(self):
        return self.keeper.seconds_to_tick(self.executor.now)

    def on_tick(self):
        assert self.keeper.take(self.executor.now)
        self.executor.now += self.cost


def served(executor, node, until):
    loop = Loop(node, executor)
    while executor.now < until:
        loop.turn()
    return node.keeper


def test_an_idle_loop_ticks_at_the_rate_of_its_node():
    executor = FakeExecutor()
    keeper = served(executor, FakeNode(executor, 0.004), until=0.9999)
    assert (keeper.taken, keeper.skipped) == (250, 0)


def test_a_flood_of_events_does_not_starve_the_ticks():
    executor = FakeExecutor(event_every=0.0001, event_cost=0.0002)
    keeper = served(executor, FakeNode(executor, 0.004), until=0.9999)
    assert (keeper.taken, keeper.skipped) == (250, 0)
    assert executor.events > 4000


def test_ticks_that_take_too_long_do_not_starve_the_events():
    executor = FakeExecutor(event_every=0.01)
    keeper = served(executor, FakeNode(executor, 0.004, tick_cost=0.006), until=1.0)
    assert executor.events >= 99
    assert keeper.skipped > 0


def test_no_wait_outlasts_the_patience_of_a_signal():
    executor = FakeExecutor()
    served(executor, FakeNode(executor, 10.0), until=25.0)
    assert max(executor.waits) == LONGEST_WAIT_S
    assert min(executor.waits) >= 0.0


def test_an_inactive_node_is_never_ticked():
    executor = FakeExecutor()
    keeper = served(executor, FakeNode(executor, 0.004, active=False), until=1.0)
    assert keeper.taken == 0
