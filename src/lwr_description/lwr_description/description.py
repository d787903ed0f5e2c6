# SPDX-License-Identifier: Apache-2.0
"""Which arm it is: everything that the workspace has to know of a serial arm."""

from dataclasses import dataclass
from math import hypot

from lwr_description.joints import JOINT_NAMES
from lwr_description.limits import POSITION_MAX, TORQUE_MAX, VELOCITY_MAX, JointLimits, read_only
from srnn_config import Parameters, parameter

_FEWEST_JOINTS = 3


@dataclass(frozen=True)
class ArmDescription(Parameters):
    """Which arm it is: model file, joints, limits, and where its tool is fixed.

    Axes, offsets and inertia come from the model. The default is the KUKA LWR 4+.
    """

    model: str = parameter(
        'lwr_description:models/lwr4p.xml',
        doc='MJCF or URDF file: an absolute path, or PACKAGE:PATH in a Python package.',
    )
    joints: tuple[str, ...] = parameter(
        JOINT_NAMES,
        doc='Names of the moving joints from base to flange; the arm is rigid at all others.',
    )
    position_min: tuple[float, ...] = parameter(
        tuple((-POSITION_MAX).tolist()), unit='rad', doc='Smallest angle of each joint.'
    )
    position_max: tuple[float, ...] = parameter(
        tuple(POSITION_MAX.tolist()), unit='rad', doc='Largest angle of each joint.'
    )
    velocity_max: tuple[float, ...] = parameter(
        tuple(VELOCITY_MAX.tolist()), unit='rad/s', above=0.0, doc='Largest speed of each joint.'
    )
    torque_max: tuple[float, ...] = parameter(
        tuple(TORQUE_MAX.tolist()), unit='Nm', above=0.0,
        doc='Largest torque of each joint, of either sign.',
    )  # fmt: skip
    flange: str = parameter('link7', doc='Body of the model that the tool rod is fixed to.')
    tool_origin: tuple[float, ...] = parameter(
        (0.0, 0.0, 0.0), unit='m', length=3,
        doc='Where the tool rod begins, in the frame of the flange body.',
    )  # fmt: skip
    tool_axis: tuple[float, ...] = parameter(
        (0.0, 0.0, 1.0), length=3, doc='Where the tool rod points, in that frame; any length.'
    )

    def check(self) -> None:
        """Refuse lists that are not of one value per joint, and limits that leave nothing."""
        count = len(self.joints)
        if count < _FEWEST_JOINTS or len(set(self.joints)) < count:
            raise self.refuse('joints', self.joints, f'{_FEWEST_JOINTS} or more different names')
        for name in ('position_min', 'position_max', 'velocity_max', 'torque_max'):
            self.one_per_joint(self, name, getattr(self, name))
        for low, high in zip(self.position_min, self.position_max, strict=True):
            if low >= high:
                raise self.refuse(
                    'position_min', self.position_min, f'< position_max = {self.position_max}'
                )
        if hypot(*self.tool_axis) == 0.0:
            raise self.refuse('tool_axis', self.tool_axis, 'a direction: not all zero')

    def one_per_joint(self, owner: Parameters, name: str, values: tuple[float, ...]) -> None:
        """Refuse a field of a parameter set that has not one value for each joint.

        Raises:
            ParameterError: names the field of `owner`, its values and the number.

        """
        if len(values) != len(self.joints):
            raise owner.refuse(name, values, f'{len(self.joints)} values, one for each joint')

    @property
    def limits(self) -> JointLimits:
        """What the joints may do at most."""
        return JointLimits(
            read_only(*self.position_min), read_only(*self.position_max),
            read_only(*self.velocity_max), read_only(*self.torque_max),
        )  # fmt: skip
