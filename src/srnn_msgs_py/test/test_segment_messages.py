# SPDX-License-Identifier: Apache-2.0
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
import numpy as np
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from trajectory_msgs.msg import JointTrajectory

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros import executed, path
from srnn_msgs_py.ros import segment as segments
from srnn_msgs_py.ros.trajectory import MAX_POINTS
from srnn_msgs_py.segment import ExecutedPath, Segment

STAMP = 1_795_000_000_123_456_789
FRAMES = st.text(st.characters(codec='utf-8', exclude_characters='\0'), max_size=20)


@st.composite
def any_segment(draw):
    """Any numbers at all, also those that no gate would let through."""
    count, width = draw(st.integers(1, 40)), draw(st.integers(1, 3))
    numbers = hnp.arrays(np.float64, (count, width), elements=st.floats(width=64))
    steps = draw(st.lists(st.integers(0, 10**9), min_size=count, max_size=count))
    times = np.cumsum(steps) / 1e9
    stamp = draw(st.integers(0, 2**31 * 10**9 - 1))
    return Segment(stamp, times, draw(numbers), draw(numbers), draw(numbers), draw(FRAMES))


def small_segment(count=3, width=2):
    grid = np.arange(count * width, dtype=float).reshape(count, width) / 100.0
    return Segment(STAMP, np.arange(count) / 10.0, grid, grid + 1.0, grid + 2.0)


@given(any_segment())
def test_a_segment_comes_back_from_the_wire_bit_for_bit(segment):
    msg = deserialize_message(serialize_message(segments.to_msg(segment)), JointTrajectory)
    back = segments.from_msg(msg)
    assert (back.stamp_ns, back.frame) == (segment.stamp_ns, segment.frame)
    np.testing.assert_array_equal(back.times, segment.times)
    for field in ('positions', 'velocities', 'accelerations'):
        np.testing.assert_array_equal(getattr(back, field), getattr(segment, field))


@given(st.lists(st.floats(0.0, 1e6), min_size=1, max_size=20))
def test_times_are_rounded_to_whole_nanoseconds(times):
    count = len(times)
    plan = ExecutedPath(STAMP, np.array(times), np.zeros((count, 2)))
    back = executed.from_msg(executed.to_msg(plan))
    assert np.abs(back.times - plan.times).max() <= 1e-9
    again = executed.from_msg(executed.to_msg(back))
    np.testing.assert_array_equal(again.times, back.times)


def test_an_executed_path_comes_back_from_the_wire(wire):
    positions = np.array([[0.1, -0.2], [0.3, 0.05]])
    path_ = ExecutedPath(STAMP, np.array([0.0, 0.5]), positions)
    back = executed.from_msg(wire(executed.to_msg(path_)))
    assert (back.stamp_ns, back.frame) == (STAMP, 'srnn_workspace')
    np.testing.assert_array_equal(back.positions, positions)


def test_an_executed_path_must_be_finite():
    positions = np.array([[0.1, np.nan]])
    msg = executed.to_msg(ExecutedPath(STAMP, np.zeros(1), positions))
    with pytest.raises(MessageError, match=r'positions\[0, 1\] = nan: must be finite'):
        executed.from_msg(msg)


@given(st.integers(0, 2), st.sampled_from(['positions', 'velocities', 'accelerations']))
def test_points_of_unequal_size_are_refused(index, field):
    msg = segments.to_msg(small_segment())
    getattr(msg.points[index], field).append(0.0)
    with pytest.raises(MessageError, match=rf'points\[{index}\].{field} has 3 values: must be 2'):
        segments.from_msg(msg)


@pytest.mark.parametrize('names', [[], ['y', 'x'], ['x', 'q'], ['x', 'y', 'z', 'w'], ['a'] * 500])
def test_unknown_axes_are_refused(names):
    msg = segments.to_msg(small_segment())
    msg.joint_names = names
    with pytest.raises(MessageError, match='joint_names = .* must be the first of'):
        segments.from_msg(msg)


def test_messages_without_points_or_with_too_many_are_refused():
    with pytest.raises(MessageError, match='0 points: must be 1 to'):
        segments.from_msg(JointTrajectory(joint_names=['x', 'y']))
    msg = segments.to_msg(small_segment())
    msg.points = msg.points * MAX_POINTS
    with pytest.raises(MessageError, match=f'{3 * MAX_POINTS} points: must be 1 to'):
        segments.from_msg(msg)


@pytest.mark.parametrize('time', [np.nan, np.inf, 1e12, -1e12])
def test_times_that_are_no_durations_are_refused(time):
    with pytest.raises(MessageError, match='time'):
        executed.to_msg(ExecutedPath(STAMP, np.array([time]), np.zeros((1, 2))))


def test_arrays_that_do_not_fit_each_other_are_refused():
    good = small_segment()
    other = Segment(STAMP, good.times, good.positions, good.velocities[:2], good.accelerations)
    with pytest.raises(MessageError, match='columns have the shapes'):
        segments.to_msg(other)
    short = Segment(STAMP, good.times[:2], good.positions, good.velocities, good.accelerations)
    with pytest.raises(MessageError, match='must be 3 finite numbers'):
        segments.to_msg(short)


def test_a_displayed_path_has_the_points_and_times_of_the_segment(wire):
    segment = small_segment()
    msg = wire(path.to_msg(segment))
    assert msg.header.frame_id == 'srnn_workspace'
    shown = path.positions(msg)
    np.testing.assert_array_equal(shown[:, :2], segment.positions)
    np.testing.assert_array_equal(shown[:, 2], 0.0)
    stamps = [p.header.stamp.sec * 10**9 + p.header.stamp.nanosec for p in msg.poses]
    assert stamps == [STAMP, STAMP + 10**8, STAMP + 2 * 10**8]
    assert all(p.pose.orientation.w == 1.0 for p in msg.poses)
