# SPDX-License-Identifier: Apache-2.0
"""A node that keeps dying is started less and less often, but never given up."""

import pytest

from srnn_bringup.restarts import FIRST_S, LONGEST_S, STEADY_S, Restarts


def test_a_node_is_started_once_when_its_pause_is_over():
    restarts = Restarts()
    assert restarts.due(0.0) == []
    pause = restarts.died('planner', 5.0)
    assert pause == FIRST_S
    assert restarts.waits('planner')
    assert restarts.due(5.0 + 0.99 * pause) == []
    assert restarts.due(5.0 + pause) == ['planner']
    assert restarts.due(1e9) == []
    assert not restarts.waits('planner')


def test_pauses_double_up_to_the_longest_and_each_node_has_its_own():
    restarts, now, pauses = Restarts(), 0.0, []
    for _ in range(12):
        pauses.append(restarts.died('tracker', now))
        now += pauses[-1]
        assert restarts.due(now) == ['tracker']
        now += 1.0
    assert pauses == [min(FIRST_S * 2**n, LONGEST_S) for n in range(12)]
    assert restarts.died('adapter', now) == FIRST_S


@pytest.mark.parametrize(('lived', 'pause'), [(0.99 * STEADY_S, 4.0), (1.01 * STEADY_S, 1.0)])
def test_who_lived_long_enough_begins_anew(lived, pause):
    restarts, now = Restarts(), 0.0
    for _ in range(2):
        now += restarts.died('planner', now)
        restarts.due(now)
    now += lived
    assert restarts.died('planner', now) == pytest.approx(pause * FIRST_S)
