# SPDX-License-Identifier: Apache-2.0
"""From a touch to the command that stops the arm, and to the tip that stands still."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics, Mount
from srnn_bag import Message
from srnn_bringup.latency.answers import answered
from srnn_config.geometry import clearance
from srnn_config.scene import Obstacle
from srnn_msgs_py.result import ResultCode
from srnn_msgs_py.ros import result, wrench
from srnn_replay.cycles import COMMANDS, MEASURED
from srnn_replay.joint_state_bytes import JointStateBytes, stamp_ns
from srnn_replay.recording import Recording

TRUTH = 'contact_truth'
TOPICS = (MEASURED, COMMANDS, 'segment_result', TRUTH)

TOUCHING_N = 0.01
"""True force from which on the arm touches something [N]; what is left of a touch is less."""

STILL = 0.01
"""What is slower stands still [m/s]: noise alone looks like half of it over `STILL_CYCLES`."""

STILL_CYCLES = 5
PATIENCE_NS = 100_000_000
"""A tip that has not come to rest this long after the stop is on its way again [ns]."""

WAY_NS = 40_000_000
"""The way before a touch is that of so long [ns]."""

PROBE = 1e-4
"""Step with which the direction of a surface is found [m]."""


@dataclass(frozen=True)
class Touch:
    """A segment that ended on contact.

    Attributes:
        stamp_ns: identity of the segment [ns].
        clear_ns: stamp of the last joint state before the touch [ns of system time].
        shown_ns: stamp of the joint state that the stop answers [ns of system time].
        stopped_ns: when the command that stops the arm was sent [ns of system time].
        still_ns: stamp of the first joint state from which on the tip stands; None if it was
            moved on before.
        speed: at which the tip went straight into the surface before the touch [m/s].

    """

    stamp_ns: int
    clear_ns: int
    shown_ns: int
    stopped_ns: int
    still_ns: int | None
    speed: float


class TouchFinder:
    """Finds the touches of a recorded run, with the truth of the simulator.

    The truth is published at 50 Hz, the largest force since the last time. Within these 20 ms,
    the last joint state with the tip clear of all obstacles of the scene comes before the touch,
    by less than one cycle of the arm.
    """

    def __init__(self, tracker: Recording, mount: Mount, obstacles: Sequence[Obstacle]) -> None:
        """Read the messages.

        Args:
            tracker: messages of at least `TOPICS`.
            mount: where the arm stands, and its tool.
            obstacles: all that the tip can touch.

        """
        self._kinematics = Kinematics(mount)
        self._radius = mount.tool_radius
        self._obstacles = obstacles
        self._reader = JointStateBytes(self._kinematics.joints)
        self._measured = sorted(tracker.raw(MEASURED), key=lambda m: stamp_ns(m.data))
        self._stamps = np.array([stamp_ns(m.data) for m in self._measured], dtype=np.int64)
        pairs = {
            (sent, stamp)
            for session in tracker.sessions for stamp, sent in answered(tracker, session).items()
        }  # fmt: skip
        self._answers = np.array(sorted(pairs), dtype=np.int64).reshape(-1, 2)
        self._results = tracker.decoded('segment_result', result.from_msg)
        truth = [decoded.value for decoded in tracker.decoded(TRUTH, wrench.from_msg)]
        self._seen = np.array([value.stamp_ns for value in truth], dtype=np.int64)
        self._touching = np.array(
            [float(np.linalg.norm(value.force)) > TOUCHING_N for value in truth], dtype=bool
        )

    def touches(self) -> list[Touch]:
        """Return the touches; those that go on from the touch before are left out."""
        found: list[Touch] = []
        before = 0
        for message, value in ((d.message, d.value) for d in self._results):
            if value.code is not ResultCode.BLOCKED:
                continue
            answer = self._answer_before(message)
            if answer is None:
                continue
            stopped, shown = answer
            clear = self._clear(stopped)
            if clear is not None and clear > before:
                still, speed = self._still(stopped), self._speed(clear)
                found.append(Touch(value.stamp_ns, clear, shown, stopped, still, speed))
            before = stopped
        return found

    def _answer_before(self, ended: Message) -> tuple[int, int] | None:
        """Return when the command of a result was sent, which precedes it, and what it answers."""
        index = int(np.searchsorted(self._answers[:, 0], ended.sent_ns, side='right'))
        if index == 0:
            return None
        sent, stamp = self._answers[index - 1].tolist()
        return sent, stamp

    def _clear(self, stopped: int) -> int | None:
        """Return when the tip was clear last before a stop; None if nothing tells of a touch."""
        end = int(np.searchsorted(self._seen, stopped)) + 1
        free = np.flatnonzero(~self._touching[:end])
        if end > len(self._seen) or not len(free) or free[-1] == end - 1:
            return None
        first, last = self._seen[free[-1]], self._seen[free[-1] + 1]
        stamps, tips = self._tips(int(first), int(last))
        if not len(tips):
            return None
        near = clearance(tips[:, :2], self._obstacles) <= self._radius
        touched = int(np.argmax(near)) if near.any() else 0
        return int(stamps[max(touched - 1, 0)])

    def _speed(self, clear: int) -> float:
        stamps, tips = self._tips(clear - WAY_NS, clear)
        velocity = (tips[-1, :2] - tips[0, :2]) / max(1e-9 * (stamps[-1] - stamps[0]), 1e-9)
        steps = PROBE * np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
        right, left, above, below = clearance(tips[-1, :2] + steps, self._obstacles)
        inward = np.array([left - right, below - above])
        return float(velocity @ inward / np.linalg.norm(inward))

    def _still(self, stopped: int) -> int | None:
        stamps, tips = self._tips(stopped, stopped + PATIENCE_NS)
        passed = 1e-9 * (stamps[STILL_CYCLES:] - stamps[:-STILL_CYCLES])
        way = np.linalg.norm(tips[STILL_CYCLES:] - tips[:-STILL_CYCLES], axis=1)
        still = np.flatnonzero(way <= STILL * passed)
        return int(stamps[still[0]]) if len(still) else None

    def _tips(self, begin: int, end: int) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Return stamps (n,) and measured tips (n, 3) of the joint states in some time."""
        places = slice(*np.searchsorted(self._stamps, (begin, end + 1)))
        data = [message.data for message in self._measured[places]]
        known, angles = self._reader.columns(data, ('position',))
        tips = [self._kinematics.tip(one) for one in angles[known, 0]]
        return self._stamps[places][known], np.array(tips, dtype=np.float64).reshape(-1, 3)
