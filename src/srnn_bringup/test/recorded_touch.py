# SPDX-License-Identifier: Apache-2.0
"""The bag of a run that never took place: one touch, whose times are known."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from rclpy.serialization import serialize_message

from lwr_description import JOINT_NAMES, Kinematics, Mount
from srnn_bag import BagWriter
from srnn_config.scene import Obstacle
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.journal import Deed, Journal, row
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import commands, joints, journal, result, segment, weights, wrench
from srnn_msgs_py.segment import FRAME, Segment
from srnn_msgs_py.topics import topic
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate
from srnn_msgs_py.wrench import Wrench
from srnn_replay.cycles import COMMANDS

MS = 1_000_000
BEGIN = 1_700_000_000_000_000_000
STEADY_S = 1234.5
"""Steady clock at `BEGIN` [s]."""

CYCLE = 4 * MS
CYCLES = 120
TOUCHED = 40
"""Number of the first joint state that touches the disc."""

STOPPED = 55
"""Number of the joint state that is answered by the stop."""

STOOD = STOPPED + 10
"""Number of the first joint state from which on the tip stands."""

MISSED = 7
"""Number of a joint state that is not answered."""

ANSWER = 800_000
SPEED = 0.1
DISC = Obstacle(shape='disc', center=(0.1, 0.0), radius=0.015)
SURFACE = 0.1 - 0.015 - Mount().tool_radius
STOP_SENT = BEGIN + STOPPED * CYCLE + ANSWER
RESULT_SENT = STOP_SENT + MS // 10
SHARED, BEGUN, SENT = 7 * MS, 9 * MS, 12 * MS
"""What follows the result of the touched segment, after it: weights, planning, segment."""

FIRST, BEFORE, AFTER = 1001, 1002, 1003
"""Stamps of segments: that which touches, one planned with the old weights, one with the new."""

DURATION_S = 0.5
NOTHING = LearnedWeights(4, 0, np.zeros(0, np.int64), np.zeros(0, np.float32))


def write(directory: Path) -> Path:
    """Write the bag."""
    with BagWriter(directory) as writer:
        put = _putter(writer)
        _arm(put)
        put('segment', BEGIN - 10 * MS, segment.to_msg(plan(FIRST)))
        stop = SegmentResult(FIRST, ResultCode.BLOCKED, 'tracking error')
        put('segment_result', RESULT_SENT, result.to_msg(stop))
        put('segment', RESULT_SENT + MS, segment.to_msg(plan(BEFORE)))
        for version, stamp, sent in ((0, 0, BEGIN - 20 * MS), (1, FIRST, RESULT_SENT + SHARED)):
            put('weights', sent, weights.to_msg(WeightsUpdate(version, stamp, NOTHING)))
        put('segment', RESULT_SENT + SENT, segment.to_msg(plan(AFTER)))
        put('planner/journal', BEGIN + 10**9, journal.to_msg(_planned()))
    return directory


def _putter(writer: BagWriter) -> Callable[[str, int, Any], None]:
    numbers: dict[str, int] = {}

    def put(name: str, sent_ns: int, msg: Any) -> None:
        if name not in numbers:
            row_of = topic(name)
            writer.add_topic(f'/{name}', row_of.type_name, row_of.qos)
        numbers[name] = numbers.get(name, 0) + 1
        data = bytes(serialize_message(msg))
        writer.write(f'/{name}', data, sent_ns + MS // 5, sent_ns, numbers[name])

    return put


def _arm(put: Callable[[str, int, Any], None]) -> None:
    """Have the tip run head-on into the disc, be stopped, spring back, and stand."""
    kinematics, still = Kinematics(Mount()), np.zeros(7)
    rows = [row(Deed.CONFIGURED), row(Deed.ACTIVATED)]
    for number in range(CYCLES):
        stamp = BEGIN + number * CYCLE
        # Half a step before and after the surface, so that rounding decides nothing.
        ahead = SPEED * 1e-9 * CYCLE * (number - TOUCHED + 0.5)
        back = 3e-4 * min(max(number - STOPPED, 0), STOOD - STOPPED)
        tip = SURFACE + min(ahead, 0.0001) - back
        sample = JointSample(stamp, kinematics.inverse((tip, 0.0, 0.0)), still, still, still)
        put('joint_states', stamp + MS // 10, joints.to_msgs(sample, JOINT_NAMES)[0])
        if number % 5 == 0:
            force = 12.0 if TOUCHED <= number <= STOPPED + 5 else 0.0
            truth = Wrench(stamp, FRAME, np.array([-force, 0.0, 0.0]), np.zeros(3))
            put('contact_truth', stamp + MS // 5, wrench.to_msg(truth))
        if number != MISSED:
            put(COMMANDS, stamp + ANSWER, commands.to_msg(sample.position))
            rows.append(row(Deed.MEASURED, stamp, 0, STEADY_S + 1e-9 * (stamp - BEGIN)))
    put('tracker/journal', BEGIN + 10**9, journal.to_msg(_journal(rows)))


def _planned() -> Journal:
    after_result = STEADY_S + 1e-9 * (RESULT_SENT - BEGIN)
    first, before = STEADY_S - 0.01, after_result + 0.001
    return _journal([
        row(Deed.CONFIGURED), row(Deed.WEIGHTS, 0),
        row(Deed.PLANNED, FIRST, 0, first - 0.004, first),
        row(Deed.ENDED, FIRST, 0, after_result),
        row(Deed.PLANNED, BEFORE, 0, before - 0.003, before),
        row(Deed.WEIGHTS, 1),
        row(Deed.PLANNED, 0, 0, after_result + 0.008),
        # It is noted a while after it was sent: the process was held up.
        row(Deed.PLANNED, AFTER, 0, after_result + 1e-9 * BEGUN, after_result + 0.015),
    ])  # fmt: skip


def _journal(rows: list[tuple[int, int, int, int, int]]) -> Journal:
    return Journal(BEGIN - 30 * MS, 0, np.array(rows, dtype=np.int64))


def plan(stamp: int) -> Segment:
    """Return a segment that stands still."""
    times = np.linspace(0.0, DURATION_S, 3)
    return Segment(stamp, times, *np.zeros((3, 3, 2)))
