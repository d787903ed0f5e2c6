# SPDX-License-Identifier: Apache-2.0
"""Joint states are found by their stamps."""

from hypothesis import given
from hypothesis import strategies as st
import numpy as np

from srnn_replay.cycles import JointStates

stamps = st.lists(st.integers(0, 20), max_size=12)


@given(stamps, stamps)
def test_each_is_found_by_its_stamp_and_the_last_of_several(held, wanted):
    order = np.argsort(np.array(held, dtype=np.int64), kind='stable')
    numbers = np.arange(len(held), dtype=float)[:, None, None]
    states = JointStates(np.array(held, dtype=np.int64)[order], numbers[order])
    by_stamp = {stamp: place for place, stamp in enumerate(held)}
    places = states.places(np.array(wanted, dtype=np.int64))
    found = [None if place < 0 else int(states.numbers[place, 0, 0]) for place in places]
    assert found == [by_stamp.get(stamp) for stamp in wanted]
