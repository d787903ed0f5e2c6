# SPDX-License-Identifier: Apache-2.0
"""A point in place of the arm: it does what it is told, and stops at obstacles."""

from dataclasses import replace
from math import hypot

import numpy as np
from numpy.typing import NDArray

from lwr_description import Mount
from lwr_tracking.core.execution import Execution, Finished
from lwr_tracking.core.parameters import TrackerParameters
from lwr_tracking.core.refusal import Refusal
from lwr_tracking.core.segment_gate import Join, judge
from srnn_config.geometry import clearance
from srnn_config.scene import Obstacle, Scene
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import Segment

CYCLE = 0.004
"""Time between two looks at the world [s], as of the arm."""

NOISE = 0.0004
"""Deviation from the commanded path [m], as measured on the simulated arm."""

NOISE_TIME = 0.1
"""Time in which the deviation changes [s]."""


NOTICED = 0.003
"""A touch is noticed when the point lags this far behind the command [m]."""


class PointWorld:
    """The tracker's gate, reference and records around a point with the radius of the tool."""

    def __init__(
        self,
        scene: Scene,
        rng: np.random.Generator,
        mount: Mount,
        tracking: TrackerParameters,
    ) -> None:
        """Hold still at the start of the scene."""
        # The point is one cycle behind its reference, whatever the arm may be.
        self._parameters = replace(tracking, law=replace(tracking.law, lead=CYCLE))
        self._rng = rng
        self._obstacles = scene.obstacles
        self._present: list[Obstacle] = []
        self._roomy: tuple[NDArray[np.float64], float] | None = None
        self._segment = 0
        self._radius = mount.tool_radius
        self._cycles = 0
        self._tip = np.array([*scene.start, 0.0])
        self._deviation = np.zeros(2)
        self._execution = Execution(self._tip.tolist(), self._parameters)
        self._last_stamp_ns: int | None = None
        self._finished: list[Finished] = []
        self.set_segment(0)

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._cycles * CYCLE

    @property
    def tip(self) -> NDArray[np.float64]:
        """Measured tip (2,) in `srnn_workspace` [m]."""
        return self._tip[:2].copy()

    @property
    def force_peak(self) -> float | None:
        """None: a point exerts no force."""
        return None

    def advance(self) -> tuple[Finished, ...]:
        """Advance by one cycle of 4 ms and return the segments that are over."""
        self._cycles += 1
        touched = self._move()
        self._finished.extend(self._execution.advance(CYCLE, self._tip.tolist()))
        if touched:
            self._finished.extend(
                self._execution.freeze(self._tip.tolist(), ResultCode.BLOCKED, 'touched', {})
            )
        finished, self._finished = tuple(self._finished), []
        return finished

    def offer(self, segment: Segment) -> SegmentResult | None:
        """Ask for a segment to be executed next; return its result if it is refused."""
        state, late = self._execution.reference.join()
        verdict = judge(segment, Join(state, late, self._last_stamp_ns), 0.0, self._parameters)
        if isinstance(verdict, Refusal):
            return SegmentResult(segment.stamp_ns, ResultCode.REJECTED, str(verdict))
        self._last_stamp_ns = segment.stamp_ns
        self._finished.extend(self._execution.accept(verdict))
        return None

    def set_segment(self, number: int) -> None:
        """Let the obstacles of segment `number` appear and the others vanish.

        An obstacle that would appear around the point waits until the point has left.
        """
        self._segment = number
        self._present = [o for o in self._present if o.present(number)]
        self._roomy = None
        self._settle()

    def _settle(self) -> None:
        for obstacle in self._obstacles:
            due = obstacle.present(self._segment) and obstacle not in self._present
            if due and clearance(self._tip[None, :2], [obstacle])[0] > self._radius:
                self._present.append(obstacle)
                self._roomy = None

    def _move(self) -> bool:
        """Go where the reference is, or stay before an obstacle; tell if that is noticed."""
        self._settle()
        reference = self._execution.reference
        keep = np.exp(-CYCLE / NOISE_TIME)
        kick = NOISE * np.sqrt(1.0 - keep**2)
        self._deviation = keep * self._deviation + kick * self._rng.standard_normal(2)
        wanted = reference.position[:2] + self._deviation
        if self._free(wanted):
            self._tip[:2] = wanted
            return False
        pressed = float(np.linalg.norm(wanted - self._tip[:2]))
        return reference.running is not None and pressed > NOTICED

    def _free(self, point: NDArray[np.float64]) -> bool:
        """Tell whether the tool fits; no nearer look within what was free around the last one."""
        if self._roomy is not None:
            centre, room = self._roomy
            if hypot(point[0] - centre[0], point[1] - centre[1]) < room:
                return True
        room = float(clearance(point[None], self._present)[0]) - self._radius
        self._roomy = point.copy(), room
        return room > 0.0
