# SPDX-License-Identifier: Apache-2.0
"""One bit makes a difference, and is named with both values."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st
import numpy as np

from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import Segment
from srnn_replay.difference import first_difference

TIMES = np.linspace(0.0, 1.0, 5)
POINTS = np.linspace(-0.2, 0.2, 10).reshape(5, 2)
SEGMENT = Segment(7, TIMES, POINTS, 2.0 * POINTS, 3.0 * POINTS)
FIELDS = st.sampled_from(['positions', 'velocities', 'accelerations'])


def copy_of(segment):
    return replace(segment, times=segment.times.copy(), positions=segment.positions.copy())


def test_the_same_is_the_same():
    assert first_difference(SEGMENT, copy_of(SEGMENT)) is None


@given(FIELDS, st.integers(0, 4), st.integers(0, 1), st.integers(0, 63))
def test_one_flipped_bit_is_found_where_it_is(field, row, column, bit):
    damaged = getattr(SEGMENT, field).copy()
    damaged.view(np.uint64)[row, column] ^= np.uint64(1 << bit)
    found = first_difference(SEGMENT, replace(SEGMENT, **{field: damaged}))
    assert found.where == f'{field}[{row}, {column}]'
    assert found.recorded == getattr(SEGMENT, field)[row, column]
    assert np.float64(found.replayed).tobytes() == damaged[row, column].tobytes()
    assert f'recorded {found.recorded!r}, replayed ' in found.words()


def test_signs_of_zero_and_kinds_differ():
    assert first_difference({'a': 0.0}, {'a': -0.0}).where == 'a'
    assert first_difference(np.zeros(2), -np.zeros(2)).where == '[0]'
    assert first_difference(np.zeros(2), np.zeros(3)).recorded == 'float64 (2,)'
    assert first_difference(1, 1.0).replayed == 1.0
    assert first_difference({'a': 1}, {'b': 1}).recorded == ['a']


def test_results_are_compared_by_all_that_they_say():
    one = SegmentResult(7, ResultCode.BLOCKED, 'force', {'force_n': 9.5})
    assert first_difference(one, replace(one, values={'force_n': 9.5})) is None
    assert first_difference(one, replace(one, values={'force_n': 9.25})).where == 'values.force_n'
    assert first_difference(one, replace(one, code=ResultCode.DONE)).where == 'code'
