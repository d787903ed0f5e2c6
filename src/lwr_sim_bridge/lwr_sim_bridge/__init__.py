# SPDX-License-Identifier: Apache-2.0
"""The LWR 4+ in MuJoCo, behaving towards its client as the real arm does."""

from lwr_sim_bridge.contact_truth import ContactForce
from lwr_sim_bridge.errors import BridgeError, SceneShapeError, SimulationError
from lwr_sim_bridge.parameters import (
    ArmParameters,
    CommandParameters,
    ContactParameters,
    ImpedanceParameters,
    MismatchParameters,
    NoiseParameters,
    ObserverParameters,
)
from lwr_sim_bridge.simulated_arm import TICK, SimulatedArm

__all__ = [
    'TICK',
    'ArmParameters',
    'BridgeError',
    'CommandParameters',
    'ContactForce',
    'ContactParameters',
    'ImpedanceParameters',
    'MismatchParameters',
    'NoiseParameters',
    'ObserverParameters',
    'SceneShapeError',
    'SimulatedArm',
    'SimulationError',
]
