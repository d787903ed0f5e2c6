# SPDX-License-Identifier: Apache-2.0
"""Which arm is mounted where, and which tool it carries."""

from dataclasses import dataclass, field
from math import pi, radians

from lwr_description.description import ArmDescription
from srnn_config import Parameters, parameter

_HOME_DEGREES = (0.0, -33.0, 0.0, 96.0, 0.0, 39.0, 0.0)


@dataclass(frozen=True)
class Mount(Parameters):
    """Pose of the base, place of the working plane, the tool rod, and which arm it is.

    World frame: x forward, y left, z up; the base stands on the z axis. The working plane is
    horizontal and its centre, straight ahead of the base, is the origin of `srnn_workspace`.
    The default (base axis horizontal, above the plane) reaches all of a 0.6 m square with at
    least 23 degrees to every joint limit.
    """

    base_height: float = parameter(
        1.15, unit='m', minimum=0.0, maximum=3.0, doc='Height of the base above the table.'
    )
    pitch: float = parameter(
        pi / 2, unit='rad', minimum=-pi, maximum=pi,
        doc='Rotation of the base about the world y axis; 0 stands upright, pi/2 points ahead.',
    )
    plane_x: float = parameter(
        0.40, unit='m', minimum=-1.2, maximum=1.2,
        doc='World x of the centre of the working plane.',
    )
    plane_z: float = parameter(
        0.25, unit='m', minimum=-1.0, maximum=3.0, doc='World height of the working plane.'
    )
    tool_length: float = parameter(
        0.30, unit='m', above=0.0, maximum=1.0,
        doc='Distance from the flange to the centre of the round end of the tool rod.',
    )
    tool_radius: float = parameter(
        0.012, unit='m', above=0.0, maximum=0.05, doc='Radius of the tool rod and its round end.'
    )
    tool_mass: float = parameter(
        0.3, unit='kg', above=0.0, maximum=5.0, doc='Mass of the tool rod.'
    )
    home: tuple[float, ...] = parameter(
        tuple(radians(angle) for angle in _HOME_DEGREES), unit='rad',
        doc='Rest posture, one angle for each joint; redundant motion is drawn towards it.',
    )
    description: ArmDescription = field(default_factory=ArmDescription)

    def check(self) -> None:
        """Refuse a home posture outside the joint limits."""
        arm = self.description
        arm.one_per_joint(self, 'home', self.home)
        limits = zip(arm.position_min, self.home, arm.position_max, strict=True)
        if not all(low <= angle <= high for low, angle, high in limits):
            raise self.refuse(
                'home', self.home,
                f'from position_min = {list(arm.position_min)} '
                f'to position_max = {list(arm.position_max)} rad',
            )
