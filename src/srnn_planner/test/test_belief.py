# SPDX-License-Identifier: Apache-2.0
"""Laws of undoing and of putting together."""

from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
import numpy as np
import pytest

from srnn_planner.core.belief import change, merged, undone
from srnn_planner.core.errors import WeightsError

SIZE = 5
PRIOR = np.linspace(-0.5, 0.5, SIZE * SIZE, dtype=np.float32).reshape(SIZE, SIZE)
POSITIONS = np.linspace(-1.0, 1.0, 2 * SIZE).reshape(SIZE, 2)
values = st.floats(-1.0, 1.0, width=32)
matrices = hnp.arrays(np.float32, (SIZE, SIZE), elements=values)
# Few values, so that many changes are of the same size.
coarse = hnp.arrays(np.float32, (SIZE, SIZE), elements=st.sampled_from([-0.5, 0.0, 0.5]))
either = matrices | coarse


@given(either, either, either)
def test_merging_is_a_choice_that_does_not_depend_on_the_order(one, other, third):
    for prior in (PRIOR, np.zeros_like(PRIOR)):
        both = merged(prior, one, other)
        np.testing.assert_array_equal(both, merged(prior, other, one))
        np.testing.assert_array_equal(
            merged(prior, both, third), merged(prior, one, merged(prior, other, third))
        )
        assert ((both == one) | (both == other)).all()


@given(matrices)
def test_merging_with_oneself_or_with_nothing_changes_nothing(one):
    assert merged(PRIOR, one, one).tobytes() == one.tobytes()
    assert merged(PRIOR, one, PRIOR).tobytes() == one.tobytes()


@given(matrices, matrices)
def test_what_was_learned_in_different_places_is_all_kept(one, other):
    left = np.arange(SIZE) < SIZE // 2
    one, other = np.where(left, one, PRIOR), np.where(left, PRIOR, other)
    np.testing.assert_array_equal(merged(PRIOR, one, other), np.where(left, one, other))


@given(matrices, matrices)
def test_the_last_update_is_undone_exactly(before, after):
    np.testing.assert_array_equal(undone(after, before, after), before)


@given(matrices, matrices, matrices)
def test_what_the_update_did_not_touch_stays(before, after, newest):
    left = np.arange(SIZE) < SIZE // 2
    after = np.where(left, after, before)
    rest = undone(newest, before, after)
    np.testing.assert_array_equal(rest[:, ~left], newest[:, ~left])
    assert (np.abs(rest) <= 1.0).all()


@given(matrices)
def test_an_update_that_changed_nothing_is_nothing_to_undo(newest):
    assert undone(newest, PRIOR, PRIOR).tobytes() == newest.tobytes()


def test_a_change_says_how_much_and_where():
    after = PRIOR.copy()
    after[:, 3] -= 0.25
    found = change(PRIOR, after, POSITIONS)
    assert found.synapses == SIZE
    assert found.largest == pytest.approx(-0.25)
    np.testing.assert_allclose(found.centre, POSITIONS[3])
    none = change(PRIOR, PRIOR, POSITIONS)
    assert (none.synapses, none.largest) == (0, 0.0)
    assert not np.isfinite(none.centre).any()


def test_weights_of_other_networks_are_refused():
    for mix in (
        lambda: merged(PRIOR, PRIOR, PRIOR[:3, :3]),
        lambda: undone(PRIOR[:3, :3], PRIOR, PRIOR),
        lambda: change(PRIOR, PRIOR[:3, :3], POSITIONS),
    ):
        with pytest.raises(WeightsError, match='different networks'):
            mix()
