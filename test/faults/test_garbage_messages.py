# SPDX-License-Identifier: Apache-2.0
"""Rows 8 and 13 on the wire: a message of garbage is refused by name, and nothing else happens."""

from array import array
from collections.abc import Callable

from builtin_interfaces.msg import Duration, Time
from moving_arm import generator, random_course
import numpy as np
import pytest
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros import segment
from srnn_msgs_py.ros.trajectory import MAX_POINTS

TICKS = 20
MESSAGES = 3

Random = np.random.Generator
COLUMNS = ('positions', 'velocities', 'accelerations')
NUMBERS = (np.nan, np.inf, -np.inf, 1e308, -1e308, 1e20)
NAMES = ([], ['x'], ['y', 'x'], ['x', 'x'], ['x', 'y', 'z'], ['x', 'y', 'z', 'w'], ['X', 'Y'],
         ['lwr_arm_0_joint'] * 7, ['', ''], ['x' * 10_000], ['ж', '\x01'])  # fmt: skip
FRAMES = ('', 'world', 'srnn_workspace/', 'SRNN_WORKSPACE', 'x' * 10_000, 'ж\x01')
COUNTS = (0, 1, MAX_POINTS + 1, 3 * MAX_POINTS)
SECONDS = (-(2**31), -5, 2**31 - 1)


def any_of(rng: Random, things):
    return things[rng.integers(len(things))]


def some_point(msg: JointTrajectory, rng: Random, first: int = 0) -> JointTrajectoryPoint:
    return msg.points[rng.integers(first, len(msg.points))]


def a_number(msg: JointTrajectory, rng: Random) -> None:
    getattr(some_point(msg, rng), any_of(rng, COLUMNS))[rng.integers(2)] = any_of(rng, NUMBERS)


def a_length(msg: JointTrajectory, rng: Random) -> None:
    count = int(any_of(rng, (0, 1, 3, 1000)))
    setattr(some_point(msg, rng), any_of(rng, COLUMNS), array('d', [0.0] * count))


def the_names(msg: JointTrajectory, rng: Random) -> None:
    msg.joint_names = list(any_of(rng, NAMES))


def the_frame(msg: JointTrajectory, rng: Random) -> None:
    msg.header.frame_id = any_of(rng, FRAMES)


def the_count(msg: JointTrajectory, rng: Random) -> None:
    msg.points = msg.points[:1] * any_of(rng, COUNTS)


def a_time(msg: JointTrajectory, rng: Random) -> None:
    # Not the last point: there, a very late time is merely slow.
    point = msg.points[rng.integers(1, len(msg.points) - 1)]
    nanosec = int(rng.integers(2**32))
    point.time_from_start = Duration(sec=int(any_of(rng, SECONDS)), nanosec=nanosec)


def the_start(msg: JointTrajectory, rng: Random) -> None:
    msg.points[0].time_from_start = Duration(nanosec=int(rng.integers(1, 2**32)))


def the_stamp(msg: JointTrajectory, rng: Random) -> None:
    msg.header.stamp = Time(sec=int(rng.integers(-(2**31), 0)), nanosec=int(rng.integers(2**32)))


def the_order(msg: JointTrajectory, rng: Random) -> None:
    msg.points = msg.points[::-1]


WAYS: dict[str, Callable[[JointTrajectory, Random], None]] = {
    'garbage for a number in a message': a_number,
    'garbage for the length of an array in a message': a_length,
    'garbage for the names in a message': the_names,
    'garbage for the frame of a message': the_frame,
    'garbage for a time in a message': a_time,
    'garbage for the start of a message': the_start,
    'garbage for the stamp of a message': the_stamp,
    'points of a message in reverse': the_order,
    'garbage for the number of points of a message': the_count,
}
"""What a message is spoiled with, in this order."""


@pytest.mark.parametrize('what', WAYS)
def test_a_message_of_garbage_changes_nothing(ledger, what):
    for repeat in range(ledger.repeats):
        rng = generator(what, repeat)
        course = random_course(rng)
        with ledger.injection(8 if WAYS[what] is a_number else 13, what, bound_ms=2.0) as entry:
            clean, attacked = course.begin(), course.begin()
            good = course.continued(rng)
            for _ in range(TICKS):
                for _ in range(MESSAGES):
                    message = segment.to_msg(good)
                    for name, spoil in WAYS.items():
                        if name == what or rng.random() < 0.2:
                            spoil(message, rng)
                    refused(attacked, message)
                clean.tick()
                attacked.tick()
                assert clean.commands[-1].tobytes() == attacked.commands[-1].tobytes()
                assert clean.arm.data.qpos.tobytes() == attacked.arm.data.qpos.tobytes()
            assert attacked.tracker.offer(segment.from_msg(segment.to_msg(good)), 0.0) is None
            entry.reaction_ms = entry.deviation_mm = 0.0


def refused(made, message: JointTrajectory) -> None:
    """Hand on a message as the node does, if the converter takes it."""
    try:
        value = segment.from_msg(message)
    except MessageError:
        return
    assert made.tracker.offer(value, 0.0) is not None
