# SPDX-License-Identifier: Apache-2.0
"""Row 21: others take the processors away, with and without real-time priority."""

from collections.abc import Iterator
import os

from bounds import VELOCITY, keeps_to_the_path
from busy_loops import busy_loops
import pytest
from watched_graph import Watched, free_scene, watched_graph

from srnn_node.realtime import VARIABLE

pytestmark = pytest.mark.slow

LOOPS = 2 * (os.cpu_count() or 1)
"""Every processor is busy, and one process waits for it."""

LOAD_S = 6.0
CYCLE_S = 0.004
MISSED = 0.05
"""Share of cycles with real-time priority; others that have it as well may be busy."""


@pytest.fixture(scope='module', params=['real-time priority', 'normal priority'])
def scheduling(request: pytest.FixtureRequest) -> Iterator[str]:
    with pytest.MonkeyPatch.context() as patch:
        if request.param == 'normal priority':
            patch.setenv(VARIABLE, '0')
        yield request.param


@pytest.fixture(scope='module')
def watched(scheduling: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watched]:
    with watched_graph(free_scene(tmp_path_factory.mktemp('scene'), VELOCITY)) as value:
        yield value


def counted(watched: Watched) -> tuple[int, int]:
    """Return how many cycles of the arm were due, and how many came late or never, as published.

    Late is what came more than a cycle after it was due.
    """
    heard = len(watched.health['sim_bridge'])
    watched.until(lambda: len(watched.health['sim_bridge']) > heard)
    values = watched.health['sim_bridge'][-1][1].values
    cycles, late, never = (int(values[name]) for name in ('cycles', 'overruns', 'skipped'))
    return cycles + never, late + never


def test_no_bound_is_broken_and_missed_cycles_are_published(ledger, watched, scheduling):
    for _ in range(ledger.repeats):
        due, missed = counted(watched)
        since = watched.now()
        with ledger.injection(21, f'overload, {scheduling}') as entry:
            with busy_loops(LOOPS):
                watched.spin(LOAD_S)
            keeps_to_the_path(watched, since, entry)
            due_then, missed_then = counted(watched)
            share = (missed_then - missed) / (due_then - due)
            print(f'overload, {scheduling}: {share:.2%} of {due_then - due} cycles missed')
            assert (due_then - due) * CYCLE_S >= 0.8 * LOAD_S
            assert share > 0.0 if scheduling == 'normal priority' else share <= MISSED
