# SPDX-License-Identifier: Apache-2.0
"""Dissonance and plasticity: closed forms, bounds, reference = kernel, what a touch teaches."""

from dataclasses import replace

from dense_weights import every
from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest
from sampling_oracle import Words
from statistical_bounds import binomial_bound

from srnn_config import ParameterError
from srnn_planner.core import plasticity, plasticity_kernel
from srnn_planner.core.adapter import Learner
from srnn_planner.core.dissonance import (
    SIGNALS,
    UntriggeredSignal,
    compare,
    learning_signal,
    within_horizon,
)
from srnn_planner.core.encoding import spike_probability
from srnn_planner.core.errors import PairingError, SrnnError, WeightsError
from srnn_planner.core.parameters import LearningParameters, ModelParameters, NetworkParameters
from srnn_planner.core.plasticity import Experience, contrast
from srnn_planner.core.random_words import seeds
from srnn_planner.core.state_neurons import StateNeurons

NEURONS = StateNeurons(NetworkParameters())
SEEDS = st.integers(0, 2**32 - 1)
STRAIGHT = np.linspace([-0.15, 0.0], [-0.05, 0.0], 30)


def stopped(path, step):
    executed = path.copy()
    executed[step:] = path[step]
    return executed


def learner(signal='local', seed=1, **learning):
    parameters = replace(LearningParameters(), signal=signal, **learning)
    return Learner(ModelParameters(learning=parameters), np.random.default_rng(seed))


@pytest.mark.parametrize('signal', sorted(set(SIGNALS) - {'untriggered'}))
def test_execution_as_imagined_teaches_nothing(signal):
    lesson = learner(signal).learn(STRAIGHT, STRAIGHT)
    assert not lesson.updated
    assert not lesson.neuron_peak.any()


def test_every_signal_has_a_name_that_parameters_accept():
    assert {LearningParameters(signal=name).signal for name in SIGNALS} == set(SIGNALS)
    with pytest.raises(ParameterError, match=f'one of {", ".join(SIGNALS)}'):
        LearningParameters(signal='mine')


def test_a_signal_of_ones_own_takes_the_place_of_the_one_that_is_named():
    class Mine(UntriggeredSignal):
        pass

    model = ModelParameters(learning=LearningParameters(signal='none', rate=0.25))
    mine = Learner(model, np.random.default_rng(1), Mine(model.learning))
    assert mine.signal == 'Mine'
    assert mine.learn(STRAIGHT, STRAIGHT).peak == 0.25
    assert Learner(model, np.random.default_rng(1)).signal == 'none'


@given(step=st.integers(0, 29), horizon=st.floats(0.01, 0.5))
def test_what_lies_beyond_the_horizon_is_not_held_against_the_world(step, horizon):
    mental = STRAIGHT / 0.3
    executed = stopped(mental, step)
    held = within_horizon(mental, executed, horizon)
    distance = np.linalg.norm(held - executed, axis=1)
    assert distance.max() <= horizon
    near = np.linalg.norm(mental - executed, axis=1) <= horizon
    assert np.array_equal(held[near], mental[near])
    assert (held[~near] == held[max(near.sum() - 1, 0)]).all()


def test_a_far_horizon_changes_nothing():
    mental = STRAIGHT / 0.3
    assert within_horizon(mental, stopped(mental, 9), 10.0) is mental


def test_global_signal_is_the_squared_distance_between_threshold_and_limit():
    p = LearningParameters(signal='global')
    offset = np.linspace(0.0, 0.9, 40)
    mental = np.column_stack([offset, np.zeros(40)])
    rates = learning_signal(p).rates(compare(NEURONS, mental, np.zeros((40, 2))))
    squared = offset**2
    expected = np.where(squared > p.global_threshold, np.minimum(squared, p.limit), 0.0)
    assert rates == pytest.approx(np.tile(expected[:, None], 225))


def test_local_signal_is_the_scaled_squared_difference_of_responsibilities():
    p = LearningParameters(signal='local')
    mental, executed = np.array([[0.0, 0.0], [0.3, 0.1]]), np.array([[0.0, 0.0], [0.0, 0.0]])
    difference = NEURONS.responsibilities(mental) - NEURONS.responsibilities(executed)
    raw = p.local_scale * difference**2
    rates = learning_signal(p).rates(compare(NEURONS, mental, executed))
    assert rates == pytest.approx(np.where(raw > p.local_threshold, np.minimum(raw, 0.3), 0.0))
    assert (rates[0] == 0.0).all()
    assert rates[1].any()


def test_constant_signal_acts_only_where_the_global_one_triggers():
    mental = np.column_stack([[0.0, 0.1, 0.2, 0.4], np.zeros(4)])
    mismatch = compare(NEURONS, mental, np.zeros((4, 2)))
    constant = learning_signal(LearningParameters(signal='constant', rate=0.07))
    assert constant.rates(mismatch)[:, 0].tolist() == [0.0, 0.0, 0.07, 0.07]
    untriggered = learning_signal(LearningParameters(signal='untriggered', rate=0.07))
    assert (untriggered.rates(mismatch) == 0.07).all()


def random_experience(rng, steps=20, neurons=20, among=30):
    rates = rng.random((steps, neurons)) * (rng.random((steps, neurons)) < 0.5)
    executed, mental = rng.random((2, steps, neurons)) * (rng.random((2, steps, neurons)) < 0.7)
    which = np.sort(rng.permutation(among)[:neurons])
    return Experience(which, executed, mental, rates)


def trains(experience, state, tau):
    """Encode both paths in plain Python, with the words of the kernel."""
    words = Words(state)
    probabilities = experience.executed, experience.mental
    last = np.full((2, len(experience.neurons)), -tau - 1)
    spikes = np.zeros((2, *experience.executed.shape), dtype=bool)
    for t in range(len(experience.executed)):
        for way, probability in enumerate(probabilities):
            for i in np.flatnonzero(probability[t]):
                if t - last[way, i] > tau and words.uniform() < probability[t, i]:
                    spikes[way, t, i] = True
                    last[way, i] = t
    return spikes


@settings(max_examples=25, deadline=None)
@given(seed=SEEDS, tau=st.integers(1, 12))
def test_kernel_gives_the_weights_of_the_reference_bit_for_bit(seed, tau):
    rng = np.random.default_rng(seed)
    experience = random_experience(rng)
    weights = rng.uniform(-1, 1, (20, 20)).astype(np.float32)
    states = seeds(rng, 5)
    pairs = [trains(experience, state, tau) for state in states]
    expected = plasticity.replay(weights, experience, pairs, tau)
    assert np.array_equal(plasticity_kernel.replay(weights, experience, states, tau), expected)


def test_encodings_of_the_kernel_have_the_probabilities_of_the_reference(rng):
    """A change of 2^-12 at every spike in the second step counts spikes of both paths.

    Two-sided bound of false-alarm rate 1e-6; the presynaptic neuron spikes in the first step.
    """
    replays, alpha = 4000, 2.0**-12
    executed, mental = np.zeros((2, 2, 3))
    executed[0, 0], executed[1, 1], mental[1, 2] = 1.0, 0.37, 0.21
    experience = Experience(np.arange(3), executed, mental, np.full((2, 3), alpha))
    weights = np.zeros((3, 3), dtype=np.float32)
    learned = plasticity_kernel.replay(weights, experience, seeds(rng, replays), 10)
    for count, probability in ((learned[0, 1], 0.37), (-learned[0, 2], 0.21)):
        bound = binomial_bound(replays, probability)
        assert abs(count / alpha - probability * replays) <= bound


@given(seed=SEEDS)
def test_weights_stay_within_their_bounds(seed):
    rng = np.random.default_rng(seed)
    weights = rng.uniform(-1, 1, (12, 12))
    executed, mental = rng.random((2, 15, 12)) < 0.3
    updated = contrast(weights, executed, mental, np.full((15, 12), 0.3), 4)
    assert np.abs(updated).max() <= 1.0


def test_one_pair_of_spikes_changes_the_weights_as_the_rule_says():
    """Executed: neuron 0 at t=0, neuron 1 at t=2. Mental: neuron 2 at t=2. alpha = 0.1."""
    executed, mental = np.zeros((2, 4, 3), dtype=bool)
    executed[0, 0] = executed[2, 1] = mental[2, 2] = True
    change = contrast(np.zeros((3, 3)), executed, mental, np.full((4, 3), 0.1), 2)
    expected = np.zeros((3, 3))
    expected[0, 1], expected[0, 2] = 0.1, -0.1
    assert change == pytest.approx(expected)


def test_potential_older_than_tau_does_not_learn():
    executed, mental = np.zeros((2, 6, 2), dtype=bool)
    executed[0, 0] = mental[4, 1] = True
    change = contrast(np.zeros((2, 2)), executed, mental, np.ones((6, 2)), 3)
    assert not change.any()


def test_only_neurons_with_a_signal_change_their_input():
    a_learner = learner('local')
    lesson = a_learner.learn(STRAIGHT, stopped(STRAIGHT, 12))
    change = a_learner.synapses.dense() - NEURONS.prior_weights
    taught = lesson.neuron_peak > 0.0
    assert lesson.updated
    assert change[:, taught].any()
    assert not change[:, ~taught].any()


@pytest.mark.parametrize('signal', ['global', 'local', 'constant'])
def test_a_touch_inhibits_the_way_ahead(signal):
    a_learner = learner(signal)
    a_learner.learn(STRAIGHT, stopped(STRAIGHT, 8))
    change = a_learner.synapses.dense() - NEURONS.prior_weights
    ahead = NEURONS.basis(STRAIGHT[-1:] / 0.3)[0] > 0.5
    assert change[:, ahead].sum() < 0.0


def test_replay_intensifies_one_experience():
    few, many = learner(replays=2), learner(replays=20)
    for each in (few, many):
        each.learn(STRAIGHT, stopped(STRAIGHT, 12))
    assert np.abs(many.synapses.change).sum() > 3.0 * np.abs(few.synapses.change).sum()


def test_same_seed_learns_the_same_weights():
    first, second = learner(seed=7), learner(seed=7)
    for each in (first, second):
        each.learn(STRAIGHT, stopped(STRAIGHT, 12))
    assert first.synapses.learned.same_as(second.synapses.learned)


def test_warming_up_changes_no_lesson():
    first, second = learner(seed=7), learner(seed=7)
    second.warm_up()
    for each in (first, second):
        each.learn(STRAIGHT, stopped(STRAIGHT, 12))
        assert each.updates == 1
    assert first.synapses.learned.same_as(second.synapses.learned)


def test_neurons_that_cannot_spike_are_left_out_of_an_experience():
    """What was left out has no responsibility, by which it could spike, in either path."""
    a_learner = learner('untriggered')
    before = a_learner.synapses.dense()
    a_learner.learn(STRAIGHT, stopped(STRAIGHT, 12))
    changed = (a_learner.synapses.dense() != before).any(axis=0)
    omega = NEURONS.responsibilities(STRAIGHT / 0.3)
    can_spike = spike_probability(omega, LearningParameters()).any(axis=0)
    assert changed.any()
    assert not changed[~can_spike].any()


def test_paths_that_do_not_belong_together_are_refused():
    a_learner = learner()
    with pytest.raises(PairingError):
        a_learner.learn(STRAIGHT, STRAIGHT[:-1])
    with pytest.raises(PairingError) as error:
        a_learner.learn(STRAIGHT, np.full_like(STRAIGHT, np.nan))
    assert isinstance(error.value, SrnnError)
    assert not len(a_learner.synapses.learned)


def test_bad_weights_leave_the_learner_as_it_was():
    a_learner = learner()
    endless = every(np.full((225, 225), np.inf, np.float32), NEURONS.prior.checksum)
    with pytest.raises(WeightsError):
        a_learner.use_weights(endless)
    assert not len(a_learner.synapses.learned)
