# SPDX-License-Identifier: Apache-2.0
"""Versions only rise, no pair is learned twice, and a killed learner goes on bit for bit."""

from dataclasses import replace

from dense_weights import every, learned
from hypothesis import given
from hypothesis import strategies as st
from lessons import MODEL, SMALL, learned_model, pair
import numpy as np
import pytest

from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.weights import MAX_VERSION, WeightsUpdate
from srnn_planner.core import checkpoint, generator_state
from srnn_planner.core.errors import PairingError, WeightsError
from srnn_planner.core.history import LENGTH
from srnn_planner.core.lineage import KEPT
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses

PAIRS = 9


def teach(model, stamps):
    for stamp in stamps:
        assert model.learn(*pair(stamp, 84 if stamp % 4 == 0 else 30), 1000 + stamp).updated


def same(a, b):
    assert a.weights.version == b.weights.version
    assert a.weights.learned.same_as(b.weights.learned)
    assert a.learner.updates == b.learner.updates
    assert np.array_equal(a.learner.random_state(), b.learner.random_state())


@pytest.mark.parametrize('killed_after', range(PAIRS))
def test_a_killed_learner_learns_what_it_would_have_learned(tmp_path, killed_after):
    straight = learned_model()
    teach(straight, range(1, PAIRS + 1))
    first = learned_model()
    teach(first, range(1, killed_after + 1))
    checkpoint.save(tmp_path / 'c', first.checkpoint())
    second = learned_model(seed=99)
    second.restore(checkpoint.load(tmp_path / 'c'), 5)
    teach(second, range(killed_after + 1, PAIRS + 1))
    same(second, straight)


@given(st.integers(0, 2**32), st.integers(0, 9), st.integers(0, 9))
def test_random_numbers_go_on_from_anywhere(seed, halves, wholes):
    rng, other = np.random.default_rng(seed), np.random.default_rng(0)
    rng.random(halves, dtype=np.float32)
    rng.random(wholes)
    generator_state.write(other, generator_state.read(rng))
    assert other.random(5, dtype=np.float32).tobytes() == rng.random(5, np.float32).tobytes()
    assert other.random(3).tobytes() == rng.random(3).tobytes()


@pytest.mark.parametrize('state', [(1, 2, 3, 4, 0, 0), (1, 2, 3, 5, 2, 0), (1, 2, 3, 5, 0, 2**32)])
def test_states_of_no_generator_are_refused(state):
    rng = np.random.default_rng(1)
    before = generator_state.read(rng)
    with pytest.raises(WeightsError, match='no state of the random number generator'):
        generator_state.write(rng, np.array(state, np.uint64))
    assert np.array_equal(generator_state.read(rng), before)


def test_the_way_back_survives_the_restart(tmp_path):
    model = learned_model()
    teach(model, range(1, 5))
    checkpoint.save(tmp_path / 'c', model.checkpoint())
    restarted = learned_model()
    restarted.restore(checkpoint.load(tmp_path / 'c'), 5)
    for either in (model, restarted):
        assert either.leave(WeightsRefusal(4, 2, ''), 6).version == 4
    same(restarted, model)
    assert (restarted.reverts, restarted.weights.version) == (1, 5)


def test_no_pair_is_learned_twice_not_even_after_a_restart():
    model = learned_model()
    teach(model, (1, 2))
    restarted = learned_model()
    restarted.restore(model.checkpoint(), 5)
    for either in (model, restarted):
        before = either.checkpoint()
        assert either.learn(*pair(1), 7) is None
        assert either.weights is before.weights
        teach(either, (3,))
    same(restarted, model)


def test_what_is_no_pair_changes_nothing():
    model = learned_model()
    before = model.checkpoint()
    plan, path = pair(1)
    far = replace(path, positions=path.positions * 1e200)
    space = np.zeros((30, 3))
    for bad in (
        (plan, replace(path, positions=path.positions[:-1])),
        (plan, replace(path, positions=path.positions * np.nan)),
        (plan, far),
        (replace(plan, positions=far.positions), path),
        (replace(plan, positions=space), replace(path, positions=space)),
        (replace(plan, positions=space[:0, :2]), replace(path, positions=space[:0, :2])),
    ):
        with pytest.raises(PairingError):
            model.learn(*bad, 5)
    assert model.weights is before.weights
    assert len(model.history.records) == 0


def test_a_refusal_takes_the_model_back_to_the_good_version_as_a_new_one():
    model = learned_model()
    versions = [model.weights.learned]
    for stamp in range(1, 6):
        teach(model, (stamp,))
        versions.append(model.weights.learned)
    assert model.leave(WeightsRefusal(4, 2, ''), 50).version == 5
    assert model.weights.version == 6
    assert model.weights.learned.same_as(versions[2])
    assert model.learner.synapses.learned is model.weights.learned
    # Told again, as after a restart of the planner: it has been done already.
    assert model.leave(WeightsRefusal(4, 2, ''), 51) is None
    assert model.leave(WeightsRefusal(9, 2, ''), 51) is None
    # A planner that knows of no good version: one step back.
    assert model.leave(WeightsRefusal(6, 0, ''), 52) is not None
    assert model.weights.learned.same_as(versions[1])
    assert model.weights.version == 7


def test_the_refusal_of_newer_weights_of_somebody_else_is_outrun():
    model = learned_model()
    teach(model, (1, 2))
    weights = model.weights
    foreign = WeightsRefusal(100, 2, '')
    assert model.leave(foreign, 5) is None
    assert model.catch_up(foreign, 5)
    assert model.weights.version == 101
    assert model.weights.learned is weights.learned is model.learner.synapses.learned
    assert not model.catch_up(foreign, 6)
    assert not model.catch_up(WeightsRefusal(50, 2, ''), 6)
    assert not model.catch_up(WeightsRefusal(MAX_VERSION, 2, ''), 6)
    teach(model, (3,))
    assert model.leave(WeightsRefusal(102, 101, ''), 7).version == 102
    assert model.weights.learned.same_as(weights.learned)


def test_ever_older_versions_end_with_the_prior():
    model = learned_model()
    teach(model, range(1, KEPT + 4))
    for count in range(1, KEPT + 2):
        assert len(model.weights.learned)
        assert model.leave(WeightsRefusal(model.weights.version, 0, ''), 5) is not None
        assert model.weights.version == KEPT + 3 + count
    assert not len(model.weights.learned)
    assert model.leave(WeightsRefusal(model.weights.version, 0, ''), 5) is None


def test_dead_initial_weights_are_left_for_the_prior():
    dead = np.full((SMALL.neurons, SMALL.neurons), -1.0, np.float32)
    model = learned_model(initial=WeightsUpdate(12, 5, learned(StateNeurons(SMALL), dead)))
    assert model.weights.version == 12
    assert model.leave(WeightsRefusal(12, 0, ''), 5).version == 12
    assert not len(model.weights.learned)
    assert model.weights.version == 13


def test_versions_only_rise_whatever_is_loaded():
    model = learned_model()
    teach(model, range(1, 4))
    nothing = Synapses(model.learner.neurons.prior).learned
    for version, expected in ((1, 4), (4, 5), (100, 100)):
        model.load(WeightsUpdate(version, 0, nothing), 5)
        assert model.weights.version == expected
    model.revert(5)
    assert model.weights.version == 101
    with pytest.raises(WeightsError):
        model.load(WeightsUpdate(500, 0, every(np.full((25, 25), 2.0), nothing.prior)), 5)
    assert model.weights.version == 101


def test_the_history_tells_what_happened_and_forgets_the_oldest():
    model = learned_model()
    teach(model, (1, 2))
    model.load(WeightsUpdate(7, 3, model.weights.learned), 20)
    model.revert(21)
    model.leave(WeightsRefusal(8, 1, ''), 22)
    restarted = learned_model()
    restarted.restore(model.checkpoint(), 23)
    records = restarted.history.records
    assert records['kind'].tolist() == [
        b'update', b'update', b'load', b'revert', b'refused', b'restart'
    ]
    assert records['version'].tolist() == [1, 2, 7, 8, 9, 9]
    assert records['from_version'].tolist() == [0, 1, 7, 0, 1, 9]
    assert records['segment_stamp_ns'].tolist()[:3] == [1, 2, 0]
    assert records['time_ns'].tolist() == [1001, 1002, 20, 21, 22, 23]
    assert records['signal'][0] == b'local'
    assert 0.0 < records['peak'][0] <= np.float32(MODEL.learning.limit)
    assert records['checksum'][-1] == model.weights.checksum()
    for n in range(LENGTH):
        restarted.revert(n)
    assert len(restarted.history.records) == LENGTH
    assert restarted.history.records['time_ns'][-1] == LENGTH - 1


def test_a_checkpoint_of_another_network_changes_nothing():
    model, other = learned_model(), learned_model(model=replace(
        MODEL, network=replace(SMALL, neurons_per_dimension=4)))
    teach(model, (1,))
    before, state = model.checkpoint(), model.learner.random_state()
    odd = replace(before, generator=np.zeros(6, np.uint64))
    taught = before.weights.learned
    nan = replace(
        before,
        earlier=(WeightsUpdate(0, 0, replace(taught, values=taught.values * np.nan)),),
    )
    for bad in (other.checkpoint(), odd, nan):
        with pytest.raises(WeightsError):
            model.restore(bad, 5)
    assert model.weights is before.weights
    assert np.array_equal(model.learner.random_state(), state)
    assert len(model.history.records) == 1
