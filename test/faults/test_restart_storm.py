# SPDX-License-Identifier: Apache-2.0
"""Row 26: every node is killed over and over while the arm learns about an obstacle."""

from collections.abc import Callable, Iterator

from bounds import LOOSELY, SPEED
from motion import Motion
import numpy as np
import pytest
from std_srvs.srv import Trigger
from watched_graph import Watched, watched_graph

from srnn_bringup.config import Choices, load
from srnn_bringup.graph import CHECKPOINT
from srnn_bringup.restarts import Restarts
from srnn_msgs_py.result import ResultCode
from srnn_msgs_py.ros import executed
from srnn_planner.core import weights_file

pytestmark = pytest.mark.slow

SEED = 26
CONFIGURATION = load(Choices(seed=SEED))
RUNNING_MS = LOOSELY * 5000.0
AFTERWARDS = 150
"""Segments after the last kill, as many as a demo has: a storm leaves little time to learn."""

PATIENCE_S = 900.0


@pytest.fixture
def watched() -> Iterator[Watched]:
    # The obstacle is near: with nothing learned, the arm may touch it until it is looked after.
    with watched_graph(CONFIGURATION, Restarts(), attended=True) as value:
        yield value


def over(watched: Watched, since: int = 0) -> list[int]:
    """Return the identities of the segments that were executed, to their end or a contact."""
    codes = (ResultCode.DONE, ResultCode.BLOCKED)
    return [r.stamp_ns for r in watched.results if r.code in codes and r.stamp_ns > since]


def contacts(watched: Watched, since: int) -> list[int]:
    return [r.stamp_ns for r in watched.results
            if r.code is ResultCode.BLOCKED and r.stamp_ns > since]  # fmt: skip


def at_work(watched: Watched, name: str) -> Callable[[], bool]:
    """Return a judge of whether a node that is started now does again what it is for."""
    started, shared, commanded = watched.now(), len(watched.weights), len(watched.commands)
    return {
        'sim_bridge': lambda: watched.joints[-1][0] > started,
        'tracker': lambda: len(watched.commands) > commanded,
        'adapter': lambda: len(watched.weights) > shared,
        'planner': lambda: watched.segments[-1].stamp_ns > started,
    }[name]


def all_go_on(watched: Watched, name: str, learned: int) -> None:
    """Wait until a segment is executed, and learned from, in spite of a node that was killed."""
    back = watched.now()
    if name == 'sim_bridge':
        # The new arm is not where the old one was: somebody has to look, and to say go on.
        assert watched.call(Trigger, 'tracker/reset').success
    if name == 'adapter':
        watched.until(lambda: len(watched.lessons) > learned)
    watched.until(lambda: over(watched, back))


def test_all_is_learned_though_every_node_dies_again_and_again(ledger, watched):
    rng = np.random.default_rng(SEED)
    ends = []
    watched.listen('executed', executed.from_msg, ends.append)
    for name in rng.permutation(np.repeat(watched.graph.names, ledger.repeats)).tolist():
        watched.spin(rng.uniform(0.5, 3.0))
        with ledger.injection(26, f'{name} killed while learning', RUNNING_MS) as entry:
            pid, learned = watched.graph.pids[name], len(watched.lessons)
            killed = watched.kill(name)
            watched.until(lambda name=name, pid=pid: watched.graph.pids[name] != pid)
            watched.until(at_work(watched, name))
            entry.reaction_ms = 1e-6 * (watched.now() - killed)
            all_go_on(watched, name, learned)
            entry.speed = Motion(watched, killed).speed
            assert entry.speed <= SPEED

    goal = len(over(watched)) + AFTERWARDS
    watched.until(lambda: len(over(watched)) >= goal, PATIENCE_S)
    third = over(watched)[-(AFTERWARDS // 3)]
    assert not contacts(watched, third)
    task = CONFIGURATION.scene.task
    blocked = np.array(CONFIGURATION.scene.waypoints[task.blocked])
    late = np.array([path.positions[-1, :2] for path in ends if path.stamp_ns >= third])
    assert np.linalg.norm(late - blocked, axis=1).min() <= task.reach_radius
    nothing_learned_was_lost(watched)


def nothing_learned_was_lost(watched: Watched) -> None:
    """A version is never followed by an older one, nor by another one of its number."""
    versions = [version for version, _ in watched.weights]
    assert versions == sorted(versions)
    assert versions[-1] > 0
    assert len(set(watched.weights)) == len(set(versions))
    acknowledged = [lesson.weights_version for lesson in watched.lessons]
    assert acknowledged == sorted(acknowledged)
    kept = weights_file.load(watched.graph._files['adapter'].parent / CHECKPOINT)
    assert (kept.version, kept.learned.checksum()) == watched.weights[-1]
    assert kept.version == acknowledged[-1]
