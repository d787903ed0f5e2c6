# SPDX-License-Identifier: Apache-2.0
"""The statistics of the evaluation: laws in closed form."""

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_experiments.evaluation.collapse import mean_of_bins, per_segment, state
from srnn_experiments.evaluation.learning_signals import binned_mean
from srnn_experiments.evaluation.mental_plan import phases
from srnn_experiments.evaluation.signal_magnitudes import cut_of_largest, mass_of_largest
from srnn_experiments.evaluation.synaptic_change import mean_change, share_near
from srnn_experiments.intervals import TRIAL_RESAMPLES, describe, trial_interval, trial_weights
from srnn_experiments.visits import Visits, spent_per_visit, visit_lengths

lengths = st.lists(st.integers(1, 300), min_size=1, max_size=30)
signals = st.lists(st.floats(0.02, 0.3), min_size=1, max_size=40)


def test_visits_count_the_segments_of_their_way_point_alone():
    active = [0, 1, 1, 1, 2, 0, 1, 2, 1, 1]
    reached = [1, 0, 0, 1, 1, 1, 1, 1, 0, 0]
    assert visit_lengths(active, reached, 1) == Visits([3, 1], 2)
    assert visit_lengths(active, reached, 2) == Visits([1, 1], 0)
    assert visit_lengths([], [], 0) == Visits([], 0)


@given(lengths)
def test_without_visits_cut_off_as_much_is_spent_as_visits_take(numbers):
    assert spent_per_visit(sum(numbers), len(numbers)) == pytest.approx(np.mean(numbers))


@given(lengths, st.integers(1, 300))
def test_a_visit_cut_off_makes_the_others_dearer(numbers, open_one):
    alone = spent_per_visit(sum(numbers), len(numbers))
    assert spent_per_visit(sum(numbers) + open_one, len(numbers)) > alone


def test_who_never_arrives_spends_endlessly():
    found = spent_per_visit(np.array([290.0, 12.0]), np.array([0.0, 2.0]))
    assert found.tolist() == [np.inf, 6.0]


@given(st.integers(1, 60), st.floats(0.0, 1.0))
def test_equal_signals_carry_as_much_as_they_are_many(count, share):
    assert mass_of_largest(np.full(count, 0.1), share) == pytest.approx(share)


@given(signals, st.integers(1, 4), st.floats(0.0, 1.0))
def test_a_weight_counts_as_often_as_the_value_were_there(values, times, share):
    once = np.array(values)
    mass = mass_of_largest(once, share)
    assert share - 1e-9 <= mass <= 1.0 + 1e-9
    assert mass_of_largest(np.repeat(once, times), share) == pytest.approx(mass)
    weights = np.full(len(once), float(times))
    assert mass_of_largest(once, share, weights) == pytest.approx(mass)


def test_the_largest_of_the_first_whole_numbers_carry_what_gauss_says():
    values = np.random.default_rng(0).permutation(np.arange(1.0, 101.0))
    largest = sum(range(86, 101))
    assert mass_of_largest(values, 0.15) == pytest.approx(largest / 5050)
    assert cut_of_largest(values, 0.15) == 86.0
    assert cut_of_largest(values, 0.001) == 100.0


def test_learning_lasts_from_the_first_touch_to_the_last_update():
    touched = [0, 0, 1, 0, 1, 0, 1]
    updated = [0, 0, 0, 0, 1, 0, 0]
    before, learning, after = ['before'] * 2, ['while'] * 3, ['after'] * 2
    assert phases(touched, updated) == before + learning + after
    assert phases([0, 1, 0], [0, 0, 0]) == ['before', 'while', 'while']
    assert phases([0, 0], [0, 0]) == ['before', 'before']
    assert phases([], []) == []


def test_means_over_bins_use_what_there_is():
    assert binned_mean([[1.0, 3.0, 5.0], [3.0, 5.0]], 2) == [3.0, 5.0]
    assert per_segment([1.0, 3.0, 5.0], 6, 2) == [2.0, None, None]
    assert mean_of_bins([[1.0, 2.0, None], [3.0, None, None]]) == [2.0, 2.0, None]


def test_a_change_is_averaged_and_located():
    trials = [{'change': {'input': [0.0, -2.0]}}, {'change': {'input': [1.0, 0.0]}}]
    assert mean_change(trials, 'input') == [0.5, -1.0]
    near = np.array([True, False, False])
    assert share_near(np.array([-1.0, 2.0, 1.0]), near) == 0.25
    assert share_near(np.zeros(3), near) is None


def test_a_trial_that_was_given_up_has_collapsed():
    assert state({'segments_executed': 99, 'still_reached': True}, 100) == 'collapsed'
    assert state({'segments_executed': 100, 'still_reached': False}, 100) == 'stranded'
    assert state({'segments_executed': 100, 'still_reached': True}, 100) == 'fine'


def test_a_sample_is_described_as_numpy_does():
    values = [1.0, 4.0, 4.0, 9.0]
    found = describe(values)
    assert found['mean'] == pytest.approx(np.mean(values))
    assert found['sd'] == pytest.approx(np.std(values, ddof=1))
    assert 1.0 <= found['low'] < found['mean'] < found['high'] <= 9.0
    assert describe([2.0]) == {'mean': 2.0, 'sd': 0.0, 'low': 2.0, 'high': 2.0}


def test_an_interval_over_trials_resamples_whole_trials():
    weights = trial_weights(7)
    assert weights.shape == (TRIAL_RESAMPLES, 7)
    assert (weights.sum(axis=1) == 7.0).all()
    values = np.array([0.0, 1.0])
    assert trial_interval(2, lambda w: float(w @ values / w.sum())) == (0.0, 1.0)
    assert trial_interval(5, lambda w: float(w.sum())) == (5.0, 5.0)
