# SPDX-License-Identifier: Apache-2.0
"""Nobody commands the arm who was not invited: strangers, recordings and second senders."""

from collections.abc import Iterator
import time

from access_world import END, LISTENERS, START, Sender, World
import numpy as np
import pytest
from sample_messages import change, changes, over_the_wire

from srnn_access import Key, Refusal

TRIES = 10_000
"""All tries of strangers together, in a run with the usual number of repeats."""

USUAL_REPEATS = 3
KINDS = {
    'nobody': {Refusal.UNSIGNED},
    'holder of another key': {Refusal.ALTERED},
    'forger of real messages': {Refusal.ALTERED, Refusal.UNSIGNED},
    'recording': {Refusal.REPLAYED},
    'recording, after a restart': {Refusal.OUTDATED},
}
COMMANDS = 'forward_position_controller/commands'
ROUNDS = -(-TRIES // (USUAL_REPEATS * len(KINDS) * len(LISTENERS)))
LATER_NS = 6_000_000_000


@pytest.fixture(scope='module', params=[True], ids=['key'])
def world(request, tmp_path_factory) -> Iterator[World]:
    made = World(tmp_path_factory.mktemp('access'), request.param)
    yield made
    made.close()


def sends(world: World, kind: str, rng: np.random.Generator):
    """Return what a stranger of this kind does to a topic."""
    recorded = {name: [over_the_wire(m) for m in world.recorded[name]] for name in LISTENERS}
    forger = Sender(world, Key(rng.bytes(32)))

    def send(name: str) -> None:
        if kind == 'nobody':
            world.publishers[name].publish(world.message(name))
        elif kind == 'holder of another key':
            forger.sends(name, world.message(name))
        else:
            msg = over_the_wire(recorded[name][rng.integers(len(recorded[name]))])
            if kind == 'forger of real messages':
                change(msg, int(rng.integers(changes(msg))))
            world.publishers[name].publish(msg)

    return send


@pytest.mark.parametrize('kind', KINDS)
def test_a_stranger_moves_nothing(world, ledger, monkeypatch, kind):
    rng = np.random.default_rng(1)
    clock = time.time_ns
    for repeat in range(ledger.repeats):
        with ledger.injection(25, f'stranger: {kind}') as entry:
            world.move()
            send = sends(world, kind, rng)
            if kind == 'recording, after a restart':
                world.end()
                late = (repeat + 1) * LATER_NS
                monkeypatch.setattr('time.time_ns', lambda late=late: clock() + late)
                world.begin()
            known = {name: world.refused(name) for name in LISTENERS}
            before, tip = world.snapshot(), world.bridge._arm.tip_truth
            world.tries(send, ROUNDS)
            assert world.snapshot() == before
            for name in LISTENERS:
                new = world.refused(name) - known[name]
                assert new.total() == ROUNDS, name
                assert set(new) <= KINDS[kind], name
            entry.deviation_mm = 1e3 * float(np.linalg.norm(world.bridge._arm.tip_truth - tip))
            world.end()
            world.begin()
    # Those who were invited are still heard.
    world.move()
    world.end()
    world.begin()


@pytest.mark.parametrize('world', [True, False], ids=['key', 'no key'], indirect=True)
def test_of_two_planners_and_two_trackers_the_first_keeps_the_arm(world, ledger):
    names = ('segment', COMMANDS)
    for _ in range(ledger.repeats):
        with ledger.injection(25, 'second planner, second tracker') as entry:
            world.move()
            before, other = world.snapshot(), Sender(world, world.key)
            for name in names:
                other.sends(name, world.message(name))
                world.until(lambda name=name: world.refused(name)[Refusal.NOT_OWNER] == 1)
            assert world.snapshot() == before
            # The motion goes on to its end, where it was meant to go.
            world.run(300)
            assert world.tracker._session.tracker.reference.at_rest
            miss = world.bridge._arm.tip_truth[:2] - END
            entry.deviation_mm = 1e3 * float(np.linalg.norm(miss))
            assert entry.deviation_mm < 1.0
            world.end()
            world.begin()


def test_the_motion_of_the_tests_is_seen(world):
    """Else it would be no wonder that nothing was moved."""
    world.move()
    before = world.snapshot()
    world.run(1)
    assert world.snapshot() != before
    assert world.bridge._arm.tip_truth[0] - START[0] > 0.002
