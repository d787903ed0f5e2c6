# SPDX-License-Identifier: Apache-2.0
"""An arm without physics for tests: it is where it was last commanded."""

from collections.abc import Iterable
from functools import cache

import numpy as np
from segments import line

from lwr_description import POSITION_MAX, Kinematics, Mount
from lwr_tracking.core import Finished, LawParameters, Tracker, TrackerParameters
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.segment import Segment

PERIOD = 0.004
# The perfect arm obeys at once: nothing has to lead.
PROMPT = TrackerParameters(law=LawParameters(lead=PERIOD))


class PerfectArm:
    """Drives one tracker; `push` is an external tip force [N], `q` can be displaced."""

    def __init__(self, parameters: TrackerParameters | None = None, start=(0.0, 0.0)) -> None:
        self.kinematics = Kinematics(Mount())
        self.tracker = Tracker(parameters or TrackerParameters(), self.kinematics)
        self.q = self.kinematics.inverse((*start, 0.0))
        self.push = np.zeros(3)
        self.now = 100.0
        self.finished: list[Finished] = []
        self.references: list[np.ndarray] = []
        self.velocities: list[np.ndarray] = []

    def sample(self) -> JointSample:
        torque = self.kinematics.jacobian(self.q).T @ self.push
        zero = np.zeros(7)
        return JointSample(int(self.now * 1e9), self.q.copy(), zero, zero, torque)

    def tick(self, dt: float = PERIOD) -> None:
        self.now += dt
        tick = self.tracker.tick(self.now, self.sample())
        self.finished += tick.finished
        self.q = tick.command
        self.references.append(self.tracker.reference.position.copy())
        self.velocities.append(self.tracker.reference.velocity.copy())

    def run(self, seconds: float, dt: float = PERIOD) -> None:
        for _ in range(round(seconds / dt)):
            self.tick(dt)

    def execute(self, segments: Iterable[Segment], patience: float = 60.0) -> None:
        """Offer each segment as soon as there is room, until all are over."""
        todo = list(segments)
        over = len(self.finished) + len(todo)
        for _ in range(int(patience / PERIOD)):
            if todo and self.tracker.reference.waiting is None:
                assert self.tracker.offer(todo.pop(0), 0.0) is None
            self.tick()
            if len(self.finished) >= over:
                return
        raise AssertionError(f'{len(self.finished)} of {over} segments are over')


def codes(arm):
    return [entry.result.code for entry in arm.finished]


def started(arm, speed=0.1, seconds=1.0):
    """Let a straight segment run for a while."""
    assert arm.tracker.offer(line((0.0, 0.0), (0.2, 0.0), speed), 0.0) is None
    arm.run(seconds)


@cache
def swivelled(margin):
    """Return a posture with the tip in the centre, a joint `margin` [rad] from its limit."""
    kinematics = Kinematics(Mount())
    q = kinematics.inverse((0.0, 0.0, 0.0))
    target = kinematics.tip(q)
    while (POSITION_MAX - np.abs(q)).min() > margin:
        still = np.linalg.svd(kinematics.jacobian(q))[2][3:]
        swivel = still.T @ still[:, 2]
        q = q + 0.01 * swivel / np.linalg.norm(swivel)
        jacobian = kinematics.jacobian(q)
        q = q - jacobian.T @ np.linalg.solve(jacobian @ jacobian.T, kinematics.tip(q) - target)
    return q
