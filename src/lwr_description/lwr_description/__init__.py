# SPDX-License-Identifier: Apache-2.0
"""The KUKA LWR 4+: model files, limits, mounting, kinematics. FRI joint order and signs."""

from lwr_description.arm_spec import MODELS, TIP_SITE, TOOL_GEOM, WORKSPACE_SITE, arm_spec
from lwr_description.errors import DescriptionError, UnreachableError
from lwr_description.joints import DOF, JOINT_NAMES
from lwr_description.kinematics import Kinematics
from lwr_description.limits import POSITION_MAX, TORQUE_MAX, VELOCITY_MAX
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
    'DescriptionError',
    'Kinematics',
    'Mount',
    'UnreachableError',
    'arm_spec',
]
