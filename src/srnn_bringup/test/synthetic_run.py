# SPDX-License-Identifier: Apache-2.0
"""Segments of a run that never took place."""

import numpy as np

from srnn_bringup.run_recorder import Recorder
from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.health import Health
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import ExecutedPath, Segment

STEPS = 11


def segment(stamp: int, start, end, duration: float = 1.0) -> Segment:
    times = np.linspace(0.0, duration, STEPS)
    positions = np.linspace(start, end, STEPS)
    speed = np.gradient(positions, times, axis=0)
    return Segment(stamp, times, positions, speed, np.zeros_like(speed))


def lesson(stamp: int, updated: bool = False, peak: float = 0.0, version: int = 0) -> Dissonance:
    return Dissonance(
        segment_stamp_ns=stamp,
        signal='local',
        updated=updated,
        weights_version=version,
        peak=peak,
        global_alpha=np.zeros(STEPS, dtype=np.float32),
        neuron_peak=np.zeros(225, dtype=np.float32),
        update_ms=2.0 * stamp,
    )


def planner_health(**values) -> dict[str, Health]:
    return {'/planner': Health(values=values)}


class Player:
    """Plays straight segments to a recorder, one after another."""

    def __init__(self, recorder: Recorder, at=(-0.03, 0.0)) -> None:
        self.recorder = recorder
        self.at = np.array(at)
        self.stamp = 0
        self.version = 0

    def go(self, target, offset=(0.0, 0.0), duration: float = 1.0, updated: bool = False) -> None:
        """Execute a segment, `offset` [m] beside the plan."""
        self._play(target, np.array(offset), ResultCode.DONE, updated, duration)

    def touch(self, target, updated: bool = True) -> None:
        """Run into something half way."""
        self._play(target, np.zeros(2), ResultCode.BLOCKED, updated, 1.0)

    def _play(self, target, offset, code, updated, duration) -> None:
        self.stamp += 1
        plan = segment(self.stamp, self.at, target, duration)
        path = plan.positions + offset
        if code is ResultCode.BLOCKED:
            path[STEPS // 2 :] = path[STEPS // 2]
        self.at = path[-1] - offset
        self.version += updated
        recorder = self.recorder
        recorder.segment(plan)
        recorder.executed(ExecutedPath(self.stamp, plan.times, path))
        values = {'force_n': 14.0} if code is ResultCode.BLOCKED else {}
        recorder.result(SegmentResult(self.stamp, code, 'force', values))
        recorder.dissonance(lesson(self.stamp, updated, 0.3 * updated, self.version))
