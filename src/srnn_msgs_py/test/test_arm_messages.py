# SPDX-License-Identifier: Apache-2.0
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
import numpy as np
import pytest

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.ros import commands, joints, markers, pose, waypoints, wrench
from srnn_msgs_py.tip import TipPosition
from srnn_msgs_py.waypoints import Waypoints
from srnn_msgs_py.wrench import Wrench

STAMP = 1_795_000_000_123_456_789
NAMES = tuple(f'joint_{i}' for i in range(7))
FINITE = st.floats(allow_nan=False, allow_infinity=False)
SEVEN = hnp.arrays(np.float64, 7, elements=FINITE)
THREE = hnp.arrays(np.float64, 3, elements=FINITE)


def sample():
    rows = np.arange(28.0).reshape(4, 7)
    return JointSample(STAMP, *rows)


@given(SEVEN, SEVEN, SEVEN, SEVEN, st.permutations(range(7)))
def test_joint_samples_come_back_in_the_order_asked_for(q, v, torque, external, order):
    sent = joints.to_msgs(JointSample(STAMP, q, v, torque, external), NAMES)
    back = joints.from_msgs(*sent, [NAMES[i] for i in order], max_lag_s=0.0)
    assert back.stamp_ns == STAMP
    np.testing.assert_array_equal(back.position, q[order])
    np.testing.assert_array_equal(back.velocity, v[order])
    np.testing.assert_array_equal(back.torque, torque[order])
    np.testing.assert_array_equal(back.external_torque, external[order])


def test_joint_samples_survive_the_wire(wire):
    measured, external = (wire(msg) for msg in joints.to_msgs(sample(), NAMES))
    back = joints.from_msgs(measured, external, NAMES, max_lag_s=0.0)
    np.testing.assert_array_equal(back.external_torque, np.arange(21.0, 28.0))


@pytest.mark.parametrize('field', ['position', 'velocity', 'effort'])
@pytest.mark.parametrize('value', [np.nan, np.inf])
def test_joint_measurements_must_be_finite(field, value):
    measured, external = joints.to_msgs(sample(), NAMES)
    getattr(measured, field)[4] = value
    with pytest.raises(MessageError, match=rf'{field}\[4\] = {value}: must be finite'):
        joints.from_msgs(measured, external, NAMES, max_lag_s=0.0)


def test_missing_joints_are_refused():
    measured, external = joints.to_msgs(sample(), NAMES)
    external.effort = external.effort[:6]
    with pytest.raises(MessageError, match='effort has 6 values: must be 7'):
        joints.from_msgs(measured, external, NAMES, max_lag_s=0.0)
    measured, external = joints.to_msgs(sample(), NAMES)
    measured.name[3] = 'gripper'
    with pytest.raises(MessageError, match='gripper.*must be joint_0, joint_1'):
        joints.from_msgs(measured, external, NAMES, max_lag_s=0.0)


def test_messages_too_far_apart_in_time_are_no_sample():
    measured, _ = joints.to_msgs(sample(), NAMES)
    _, old = joints.to_msgs(JointSample(STAMP - 5_000_000, *np.zeros((4, 7))), NAMES)
    assert joints.from_msgs(measured, old, NAMES, max_lag_s=0.005).stamp_ns == STAMP
    with pytest.raises(MessageError, match=r'5\.0 ms from the joint state: must be <= 4\.0 ms'):
        joints.from_msgs(measured, old, NAMES, max_lag_s=0.004)


@given(SEVEN)
def test_commands_come_back(command):
    np.testing.assert_array_equal(commands.from_msg(commands.to_msg(command), 7), command)


@given(hnp.arrays(np.float64, st.integers(0, 12), elements=st.floats()))
def test_only_seven_finite_numbers_are_a_command(values):
    msg = commands.to_msg(values)
    if len(values) == 7 and np.isfinite(values).all():
        assert commands.from_msg(msg, 7).shape == (7,)
    else:
        with pytest.raises(MessageError, match='must be'):
            commands.from_msg(msg, 7)


@given(THREE, st.integers(0, 2**31 * 10**9 - 1))
def test_tip_positions_come_back(position, stamp):
    back = pose.from_msg(pose.to_msg(TipPosition(stamp, position)))
    assert (back.stamp_ns, back.frame) == (stamp, 'srnn_workspace')
    np.testing.assert_array_equal(back.position, position)


def test_tip_positions_must_be_finite():
    msg = pose.to_msg(TipPosition(STAMP, np.array([0.0, np.nan, 0.0])))
    with pytest.raises(MessageError, match='position = .*must be finite'):
        pose.from_msg(msg)


@given(hnp.arrays(np.float64, st.tuples(st.integers(1, 100), st.just(3)), elements=FINITE))
def test_waypoints_come_back(points):
    back = waypoints.from_msg(waypoints.to_msg(Waypoints(STAMP, points)))
    assert (back.stamp_ns, back.frame) == (STAMP, 'srnn_workspace')
    np.testing.assert_array_equal(back.points, points)


def test_planar_waypoints_lie_in_the_plane(wire):
    msg = wire(waypoints.to_msg(Waypoints(STAMP, np.array([[0.1, 0.2]]))))
    np.testing.assert_array_equal(waypoints.from_msg(msg).points, [[0.1, 0.2, 0.0]])


@pytest.mark.parametrize('count', [0, 101])
def test_a_tour_has_some_points_but_not_endlessly_many(count):
    msg = waypoints.to_msg(Waypoints(STAMP, np.zeros((count, 3))))
    with pytest.raises(MessageError, match=f'{count} poses: must be 1 to 100'):
        waypoints.from_msg(msg)


def test_waypoints_must_be_finite():
    msg = waypoints.to_msg(Waypoints(STAMP, np.array([[0.0, 0.0], [np.inf, 0.0]])))
    with pytest.raises(MessageError, match=r'poses\[1\].position = .*must be finite'):
        waypoints.from_msg(msg)


@given(THREE, THREE)
def test_wrenches_come_back(force, torque):
    back = wrench.from_msg(wrench.to_msg(Wrench(STAMP, 'lwr_tool', force, torque)))
    assert (back.stamp_ns, back.frame) == (STAMP, 'lwr_tool')
    np.testing.assert_array_equal(back.force, force)
    np.testing.assert_array_equal(back.torque, torque)


def test_wrenches_must_be_finite():
    msg = wrench.to_msg(Wrench(STAMP, 'lwr_tool', np.zeros(3), np.array([0.0, 0.0, np.nan])))
    with pytest.raises(MessageError, match='torque = .*must be finite'):
        wrench.from_msg(msg)


def test_a_displayed_tour_has_the_points_their_radius_and_the_next_one(wire):
    points = np.array([[0.1, 0.2, 0.0], [-0.1, 0.0, 0.0], [0.0, 0.3, 0.0]])
    shown = markers.from_msg(wire(markers.to_msg(Waypoints(STAMP, points), 1, 0.03)))
    np.testing.assert_allclose([point for point, _, _ in shown], points[:, :2])
    np.testing.assert_allclose([radius for _, radius, _ in shown], 0.03)
    assert [active for _, _, active in shown] == [False, True, False]
