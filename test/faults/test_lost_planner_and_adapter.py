# SPDX-License-Identifier: Apache-2.0
"""Rows 1 to 3: what plans or learns is killed, or hangs while its process lives on."""

from collections.abc import Iterator
import signal

from bounds import LOOSELY, VELOCITY, keeps_to_the_path
import numpy as np
import pytest
from watched_graph import Watched, free_scene, watched_graph

pytestmark = pytest.mark.slow

NEW_SEGMENT_MS = LOOSELY * 2000.0


@pytest.fixture(scope='module')
def watched(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watched]:
    with watched_graph(free_scene(tmp_path_factory.mktemp('scene'), VELOCITY)) as value:
        yield value


def comes_to_rest(watched: Watched) -> None:
    """Wait until all that was sent is over; then the arm must stand still."""
    watched.spin(0.2)
    watched.until(
        lambda: {s.stamp_ns for s in watched.segments} <= {r.stamp_ns for r in watched.results}
    )
    assert watched.stands_still()


def test_a_planner_that_is_killed_leaves_the_arm_at_rest_on_its_path(ledger, watched):
    rng = np.random.default_rng(1)
    for _ in range(ledger.repeats):
        since = watched.under_way(rng)
        with ledger.injection(1, 'planner killed in mid-segment', NEW_SEGMENT_MS) as entry:
            watched.kill('planner')
            comes_to_rest(watched)
            began = watched.restart('planner')
            entry.reaction_ms = 1e-6 * (watched.first_executed(began) - began)
            keeps_to_the_path(watched, since, entry)


def test_a_planner_that_hangs_is_as_good_as_dead_and_goes_on_when_it_wakes(ledger, watched):
    rng = np.random.default_rng(2)
    for _ in range(ledger.repeats):
        since = watched.under_way(rng)
        with ledger.injection(2, 'planner stopped in mid-segment', NEW_SEGMENT_MS) as entry:
            watched.kill('planner', signal.SIGSTOP)
            try:
                comes_to_rest(watched)
            finally:
                woken = watched.kill('planner', signal.SIGCONT)
            entry.reaction_ms = 1e-6 * (watched.first_executed(woken) - woken)
            keeps_to_the_path(watched, since, entry)


def goes_on_undisturbed(watched: Watched, since: int, entry) -> None:
    before = len(watched.done())
    watched.until(lambda: len(watched.done()) >= before + 3)
    keeps_to_the_path(watched, since, entry)
    from_rest = [s for s in watched.segments if s.stamp_ns > since and not s.velocities[0].any()]
    # A pause of the whole machine may make one planner late, the adapter must make none.
    assert len(from_rest) <= 1


def test_motion_goes_on_undisturbed_while_the_adapter_is_dead(ledger, watched):
    rng = np.random.default_rng(3)
    for _ in range(ledger.repeats):
        since, heard = watched.under_way(rng), len(watched.weights)
        with ledger.injection(3, 'adapter killed in mid-segment') as entry:
            watched.kill('adapter')
            goes_on_undisturbed(watched, since, entry)
            began = watched.restart('adapter')
            watched.until(lambda heard=heard: len(watched.weights) > heard)
            entry.reaction_ms = 1e-6 * (watched.now() - began)
            assert watched.weights[-1] == watched.weights[heard - 1]


def test_motion_goes_on_undisturbed_while_the_adapter_hangs(ledger, watched):
    rng = np.random.default_rng(4)
    for _ in range(ledger.repeats):
        since, heard = watched.under_way(rng), len(watched.lessons)
        with ledger.injection(3, 'adapter stopped in mid-segment') as entry:
            watched.kill('adapter', signal.SIGSTOP)
            try:
                goes_on_undisturbed(watched, since, entry)
            finally:
                watched.kill('adapter', signal.SIGCONT)
            watched.until(lambda heard=heard: len(watched.lessons) > heard)
