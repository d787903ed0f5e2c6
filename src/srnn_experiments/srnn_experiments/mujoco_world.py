# SPDX-License-Identifier: Apache-2.0
"""The tracker and the simulated arm, as in the live graph."""

import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics, Mount
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.simulated_arm import SimulatedArm
from lwr_tracking.core.execution import Finished
from lwr_tracking.core.parameters import TrackerParameters
from lwr_tracking.core.tracker import Tracker
from srnn_config.scene import Scene
from srnn_msgs_py.result import SegmentResult
from srnn_msgs_py.segment import Segment

TICKS_PER_CYCLE = 4
"""The arm is simulated at 1 kHz, measured and commanded at 250 Hz."""


class MujocoWorld:
    """An arm in MuJoCo that stops on contact by what the tracker estimates.

    Attributes:
        arm: the simulated arm.
        tracker: what moves it.
        command: (n,) last joint command [rad], None before the first.

    """

    def __init__(
        self,
        scene: Scene,
        rng: np.random.Generator,
        mount: Mount,
        tracking: TrackerParameters,
        arm: ArmParameters,
    ) -> None:
        """Hold still at the start of the scene."""
        self.arm = SimulatedArm(arm, mount, scene, rng)
        self.tracker = Tracker(tracking, Kinematics(mount))
        self.command: NDArray[np.float64] | None = None

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self.arm.time

    @property
    def tip(self) -> NDArray[np.float64]:
        """Measured tip (2,) in `srnn_workspace` [m]."""
        return self.tracker.tip[:2].copy()

    @property
    def force_peak(self) -> float | None:
        """Largest low-passed true contact force [N]."""
        return self.arm.truth.peak

    def advance(self) -> tuple[Finished, ...]:
        """Advance by one measurement of the arm and return the segments that are over."""
        self.arm.step(TICKS_PER_CYCLE)
        now = self.arm.time
        tick = self.tracker.tick(now, self.arm.sample(round(now * 1e9)))
        self.command = tick.command
        if tick.command is not None:
            self.arm.command(tick.command)
        return tick.finished

    def offer(self, segment: Segment) -> SegmentResult | None:
        """Ask for a segment to be executed next; return its result if it is refused."""
        return self.tracker.offer(segment, 0.0)

    def set_segment(self, number: int) -> None:
        """Let the obstacles of segment `number` appear and the others vanish."""
        self.arm.set_segment(number)
