# SPDX-License-Identifier: Apache-2.0
"""Rows 4 and 5: what moves the arm, or is the arm, is killed, or hangs."""

from collections.abc import Iterator
import signal

from bounds import LOOSELY, SPEED, VELOCITY, keeps_to_the_path, nearly_stands_still
from motion import Motion
import numpy as np
import pytest
from std_srvs.srv import Trigger
from watched_graph import Watched, free_scene, watched_graph

from srnn_msgs_py.health import HealthLevel

pytestmark = pytest.mark.slow

REST_MS = LOOSELY * 510.0
RUNNING_MS = LOOSELY * 5000.0
SILENCE_S = 1.0
TRAVEL_MM = 15.0
HELD_MM = 1.0


@pytest.fixture(scope='module')
def watched(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watched]:
    with watched_graph(free_scene(tmp_path_factory.mktemp('scene'), VELOCITY)) as value:
        yield value


def is_latched(watched: Watched, since: int) -> bool:
    """Tell whether the tracker has said that it wants a reset."""
    return any(
        health.level is HealthLevel.ERROR
        for heard, health in watched.health['tracker'] if heard > since
    )  # fmt: skip


def goes_on_after_reset(watched: Watched, entry) -> None:
    """Reset the tracker once, as an operator would; the arm must not leave its paths."""
    reset = watched.now()
    assert watched.call(Trigger, 'tracker/reset').success
    watched.first_executed(reset)
    keeps_to_the_path(watched, reset, entry)


def test_without_its_tracker_the_arm_soon_stands_and_a_new_one_goes_on(ledger, watched):
    rng = np.random.default_rng(1)
    for _ in range(ledger.repeats):
        watched.under_way(rng)
        with ledger.injection(4, 'tracker killed in mid-segment', REST_MS) as entry:
            killed = watched.kill('tracker')
            watched.spin(1.0)
            motion = nearly_stands_still(watched, killed, entry, TRAVEL_MM)
            entry.reaction_ms = motion.rest_ms()
        with ledger.injection(4, 'tracker started anew', RUNNING_MS) as entry:
            began = watched.restart('tracker')
            entry.reaction_ms = 1e-6 * (watched.first_executed(began) - began)
            keeps_to_the_path(watched, began, entry)


def test_a_tracker_that_hangs_for_a_moment_goes_on_without_a_jump(ledger, watched):
    rng = np.random.default_rng(2)
    for _ in range(ledger.repeats):
        since = watched.under_way(rng)
        with ledger.injection(4, 'tracker stopped for less than 1 s', RUNNING_MS) as entry:
            stopped = watched.kill('tracker', signal.SIGSTOP)
            watched.spin(rng.uniform(0.03, 0.6))
            nearly_stands_still(watched, stopped, entry, TRAVEL_MM)
            woken = watched.kill('tracker', signal.SIGCONT)
            entry.reaction_ms = 1e-6 * (watched.first_executed(woken) - woken)
            keeps_to_the_path(watched, since, entry)


def test_a_tracker_that_hung_for_long_waits_for_a_reset(ledger, watched):
    rng = np.random.default_rng(3)
    for _ in range(ledger.repeats):
        watched.under_way(rng)
        with ledger.injection(4, 'tracker stopped for 2 s, reset', REST_MS) as entry:
            stopped = watched.kill('tracker', signal.SIGSTOP)
            watched.spin(2.0)
            motion = nearly_stands_still(watched, stopped, entry, TRAVEL_MM)
            entry.reaction_ms = motion.rest_ms()
            woken = watched.kill('tracker', signal.SIGCONT)
            watched.until(lambda woken=woken: is_latched(watched, woken))
            watched.spin(0.5)
            nearly_stands_still(watched, woken, entry, TRAVEL_MM)
            goes_on_after_reset(watched, entry)


def test_a_new_arm_is_told_nothing_of_before_and_waits_for_a_reset(ledger, watched):
    rng = np.random.default_rng(4)
    for _ in range(ledger.repeats):
        watched.under_way(rng)
        with ledger.injection(5, 'bridge killed in mid-segment', RUNNING_MS) as entry:
            killed = watched.kill('sim_bridge')
            watched.until(lambda killed=killed: is_latched(watched, killed))
            assert watched.now() - killed > 1e9 * SILENCE_S
            told = len(watched.commands)
            began = watched.restart('sim_bridge')
            watched.until(lambda began=began: watched.joints[-1][0] > began)
            entry.reaction_ms = 1e-6 * (watched.joints[-1][0] - began)
            watched.spin(1.0)
            assert len(watched.commands) == told
            nearly_stands_still(watched, began, entry, HELD_MM)
            goes_on_after_reset(watched, entry)


def test_an_arm_that_is_soon_back_elsewhere_is_not_led_where_the_last_one_was(ledger, watched):
    """Here silence may not have stopped the tracker; a small jump may even be believed."""
    rng = np.random.default_rng(5)
    for _ in range(ledger.repeats):
        watched.under_way(rng)
        with ledger.injection(5, 'bridge killed, started at once', RUNNING_MS) as entry:
            watched.kill('sim_bridge')
            began = watched.restart('sim_bridge')
            watched.until(lambda began=began: watched.joints[-1][0] > began)
            entry.reaction_ms = 1e-6 * (watched.joints[-1][0] - began)
            watched.spin(1.0)
            if is_latched(watched, began):
                nearly_stands_still(watched, began, entry, TRAVEL_MM)
                assert watched.call(Trigger, 'tracker/reset').success
            watched.first_executed(watched.now())
            entry.speed = Motion(watched, began).speed
            assert entry.speed <= SPEED
