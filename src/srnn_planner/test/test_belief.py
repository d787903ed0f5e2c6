# SPDX-License-Identifier: Apache-2.0
"""Laws of undoing and of putting together."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
import numpy as np
import pytest

from srnn_planner.core.belief import change, correlation, merged, undone
from srnn_planner.core.errors import WeightsError
from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.prior import PriorWeights
from srnn_planner.core.synapses import Synapses

SIZE = 5
NETWORK = NetworkParameters(dimensions=1, neurons_per_dimension=SIZE, sigma=0.3)
PRIORS = [PriorWeights(replace(NETWORK, weight_gain=gain)) for gain in (1.0, 80.0, 1e-8)]
"""Of all weights, of many at their limit, and all at rest."""
POSITIONS = np.linspace(-1.0, 1.0, SIZE)[:, None]
values = st.floats(-1.0, 1.0, width=32)
matrices = hnp.arrays(np.float32, (SIZE, SIZE), elements=values)
# Few values, so that many changes are of the same size.
coarse = hnp.arrays(np.float32, (SIZE, SIZE), elements=st.sampled_from([-0.5, 0.0, 0.5]))
either = matrices | coarse


def of(*weights, prior=PRIORS[0]):
    """Return synapses for weights (K, K)."""
    return [Synapses.of(prior, each) for each in weights]


def same(one, other):
    return np.array_equal(one.dense(), other.dense())


def same_bits(one, other):
    return one.learned.same_as(other.learned)


@given(either, either, either)
def test_merging_is_a_choice_that_does_not_depend_on_the_order(one, other, third):
    for prior in PRIORS:
        first, second, last = of(one, other, third, prior=prior)
        both = merged(first, second)
        assert same(both, merged(second, first))
        assert same(merged(both, last), merged(first, merged(second, last)))
        assert ((both.dense() == one) | (both.dense() == other)).all()


@given(matrices)
def test_merging_with_oneself_or_with_nothing_changes_nothing(one):
    (synapses,) = of(one)
    assert same_bits(merged(synapses, synapses), synapses)
    assert same_bits(merged(synapses, Synapses(PRIORS[0])), synapses)


@given(matrices, matrices)
def test_what_was_learned_in_different_places_is_all_kept(one, other):
    left, prior = np.arange(SIZE) < SIZE // 2, PRIORS[0].dense()
    both = merged(*of(np.where(left, one, prior), np.where(left, prior, other)))
    np.testing.assert_array_equal(both.dense(), np.where(left, one, other))


@given(matrices, matrices)
def test_the_last_update_is_undone_exactly(before, after):
    old, new = of(before, after)
    assert same(undone(new, old, new), old)


@given(matrices, matrices, matrices)
def test_what_the_update_did_not_touch_stays(before, after, newest):
    left = np.arange(SIZE) < SIZE // 2
    after = np.where(left, after, before)
    rest = undone(*of(newest, before, after)).dense()
    np.testing.assert_array_equal(rest[:, ~left], newest[:, ~left])
    assert (np.abs(rest) <= 1.0).all()


@given(matrices)
def test_an_update_that_changed_nothing_is_nothing_to_undo(newest):
    (synapses,), nothing = of(newest), Synapses(PRIORS[0])
    assert same_bits(undone(synapses, nothing, nothing), synapses)


def test_a_change_says_how_much_and_where():
    prior = PRIORS[0].dense()
    after = prior.copy()
    after[:, 3] -= 0.25
    found = change(*of(prior, after))
    assert found.synapses == SIZE
    assert found.largest == pytest.approx(-0.25)
    np.testing.assert_allclose(found.centre, POSITIONS[3])
    none = change(*of(prior, prior))
    assert (none.synapses, none.largest) == (0, 0.0)
    assert not np.isfinite(none.centre).any()


@given(matrices, matrices, matrices)
def test_the_correlation_is_that_of_all_changes_and_none_of_nothing(before, one, other):
    old, first, second = of(before, one, other)
    changes = [(after.astype(float) - before).ravel() for after in (one, other)]
    found = correlation((old, first), (old, second))
    if min(np.ptp(change) for change in changes) > 1e-3:
        assert found == pytest.approx(np.corrcoef(*changes)[0, 1], abs=1e-6)
    assert np.isnan(correlation((old, old), (old, second)))


def test_weights_of_other_networks_are_refused():
    (one,), (other,) = of(PRIORS[0].dense()), of(PRIORS[1].dense(), prior=PRIORS[1])
    for mix in (
        lambda: merged(one, other),
        lambda: undone(one, one, other),
        lambda: change(other, one),
    ):
        with pytest.raises(WeightsError, match='beside the priors .* must be one'):
            mix()
