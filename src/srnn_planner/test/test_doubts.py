# SPDX-License-Identifier: Apache-2.0
"""When a planner doubts that it sees the arm, or that its clock is right."""

from hypothesis import given
from hypothesis import strategies as st
import pytest

from srnn_msgs_py.result import ResultCode
from srnn_planner.core.doubts import BLIND_S, STALE_IN_A_ROW, Doubts

OTHERS = [code for code in ResultCode if code is not ResultCode.STALE]


@pytest.mark.parametrize('now', [0.0, 1e6])
def test_before_a_pose_nobody_knows_where_the_arm_is(now):
    assert Doubts().blind(now)


@given(st.floats(0.0, 1e5), st.floats(0.0, 2.0 * BLIND_S))
def test_a_pose_is_good_for_a_while(seen, later):
    doubts = Doubts()
    doubts.posed(seen)
    now = seen + later
    assert doubts.blind(now) == (now - seen > BLIND_S)
    assert (doubts.words(now) != '') == doubts.blind(now)


@given(st.lists(st.sampled_from(list(ResultCode)), max_size=12))
def test_only_many_stale_segments_in_a_row_make_a_clock_doubtful(codes):
    doubts = Doubts()
    doubts.posed(0.0)
    for code in codes:
        doubts.ended(code)
    last = codes[-STALE_IN_A_ROW:]
    stale = len(last) == STALE_IN_A_ROW and set(last) == {ResultCode.STALE}
    assert ('clocks' in doubts.words(0.0)) == stale


def test_not_to_see_the_arm_is_graver():
    doubts = Doubts()
    for _ in range(STALE_IN_A_ROW):
        doubts.ended(ResultCode.STALE)
    assert doubts.words(0.0) == 'no pose of the arm: nothing is planned'
