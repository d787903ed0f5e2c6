# SPDX-License-Identifier: Apache-2.0
"""The arm: description, model, limits, mounting, kinematics; the KUKA LWR 4+ by default."""

from lwr_description.arm_spec import MODELS, TIP_SITE, TOOL_GEOM, WORKSPACE_SITE, arm_spec
from lwr_description.description import ArmDescription
from lwr_description.errors import (
    DescriptionError,
    MissingModelError,
    ModelError,
    UnreachableError,
)
from lwr_description.joints import DOF, JOINT_NAMES
from lwr_description.kinematics import Kinematics
from lwr_description.limits import POSITION_MAX, TORQUE_MAX, VELOCITY_MAX, JointLimits
from lwr_description.model_file import find_model
from lwr_description.mount import Mount

__all__ = [
    'DOF',
    'JOINT_NAMES',
    'MODELS',
    'POSITION_MAX',
    'TIP_SITE',
    'TOOL_GEOM',
    'TORQUE_MAX',
    'VELOCITY_MAX',
    'WORKSPACE_SITE',
    'ArmDescription',
    'DescriptionError',
    'JointLimits',
    'Kinematics',
    'MissingModelError',
    'ModelError',
    'Mount',
    'UnreachableError',
    'arm_spec',
    'find_model',
]
