# SPDX-License-Identifier: Apache-2.0
"""What is tried: one row of a table, without the seed."""

from dataclasses import dataclass, field, fields, is_dataclass, replace
import hashlib
from typing import Any

import numpy as np

from lwr_description import ArmDescription, Mount, find_model
from lwr_sim_bridge.parameters import ArmParameters
from lwr_tracking.core.parameters import TrackerParameters
from srnn_config.scene import Scene
from srnn_experiments.agent import Brain
from srnn_msgs_py.weights import LearnedWeights


@dataclass(frozen=True, eq=False)
class Setting:
    """Everything that determines a trial, except its seed.

    Attributes:
        scene: task and obstacles.
        brain: network, learning and planning.
        segments: length of a trial.
        world: one of `choices.WORLDS`.
        agent: one of `choices.AGENTS`.
        mount: where the arm stands and what it holds.
        arm: the simulated arm; of no meaning to a point.
        tracking: the tracker.
        weights: what was learned before; None for nothing.

    """

    scene: Scene
    brain: Brain
    segments: int
    world: str = 'mujoco'
    agent: str = 'network'
    mount: Mount = field(default_factory=Mount)
    arm: ArmParameters = field(default_factory=ArmParameters)
    tracking: TrackerParameters = field(default_factory=TrackerParameters)
    weights: LearnedWeights | None = None

    def with_signal(self, signal: str, rate: float | None = None) -> 'Setting':
        """Return the setting with another learning signal."""
        learning = replace(self.brain.model.learning, signal=signal)
        if rate is not None:
            learning = replace(learning, rate=rate)
        model = replace(self.brain.model, learning=learning)
        return replace(self, brain=replace(self.brain, model=model))

    @property
    def arm_model(self) -> str | None:
        """Model of the arm that is moved; None in the world of a point."""
        return None if self.world == 'point' else self.mount.description.model

    @property
    def place(self) -> str:
        """The world, and the arm in it if it is not the usual one, in words."""
        return f'world {self.world}' + (f', arm {self.arm_model}' if self._other_arm else '')

    @property
    def _other_arm(self) -> bool:
        return self.arm_model not in (None, ArmDescription().model)

    def digest(self) -> str:
        """Return 16 hex digits that differ when anything differs that changes a trial."""
        state = hashlib.sha256()
        _feed(state, self)
        if self._other_arm:
            # The model of the LWR 4+ is a part of this code; others may change beneath it.
            state.update(find_model(self.mount.description.model).read_bytes())
        return state.hexdigest()[:16]


def _feed(state: Any, value: Any) -> None:
    if is_dataclass(value) and not isinstance(value, type):
        state.update(type(value).__name__.encode())
        for item in fields(value):
            state.update(item.name.encode())
            _feed(state, getattr(value, item.name))
    elif isinstance(value, np.ndarray):
        state.update(str((value.shape, value.dtype)).encode() + value.tobytes())
    else:
        state.update(repr(value).encode() + b';')
