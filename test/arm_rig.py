# SPDX-License-Identifier: Apache-2.0
"""Tracker and simulated arm without middleware, on simulated time."""

from dataclasses import dataclass, field

import numpy as np

from lwr_description import Kinematics, Mount
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.simulated_arm import SimulatedArm
from lwr_tracking.core import Finished, Tracker, TrackerParameters
from srnn_config.scene import build_scene

PERIOD = 0.004
PHYSICS_PER_TICK = 4


@dataclass
class Rig:
    """Tracker and simulated arm, stepped together."""

    arm: SimulatedArm
    tracker: Tracker
    finished: list[Finished] = field(default_factory=list)
    force: list[float] = field(default_factory=list)
    tips: list[np.ndarray] = field(default_factory=list)
    commands: list[np.ndarray] = field(default_factory=list)

    def tick(self) -> None:
        sample = self.arm.sample(int(self.arm.time * 1e9))
        tick = self.tracker.tick(self.arm.time, sample)
        assert self.arm.command(tick.command) is None
        for _ in range(PHYSICS_PER_TICK):
            self.arm.step()
        self.commands.append(tick.command)
        self.finished += tick.finished
        self.force.append(self.tracker.contact.force)
        self.tips.append(self.arm.tip_truth)

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / PERIOD)):
            self.tick()
        assert not self.arm.data.warning.number.any()

    def execute(self, segments) -> None:
        """Offer every segment in good time and run until all are over."""
        todo = list(segments)
        over = len(self.finished) + len(todo)
        while len(self.finished) < over:
            if todo and self.tracker.reference.waiting is None:
                assert self.tracker.offer(todo.pop(0), 0.0) is None
            self.tick()
        assert not self.arm.data.warning.number.any()

    def present_force(self) -> float:
        return float(np.linalg.norm(self.arm.truth.low_pass))


def rig(obstacles=(), seed=1, start=(0.0, 0.0), **arm_parameters) -> Rig:
    task = {'name': 'test', 'waypoints': [list(start)], 'obstacles': list(obstacles)}
    scene = build_scene(task, '')
    parameters = ArmParameters(**arm_parameters)
    arm = SimulatedArm(parameters, Mount(), scene, np.random.default_rng(seed))
    made = Rig(arm, Tracker(TrackerParameters(), Kinematics(Mount())))
    made.run(0.4)
    return made
