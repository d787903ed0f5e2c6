# SPDX-License-Identifier: Apache-2.0
"""Parameters of the tracker, one set per part."""

from dataclasses import dataclass, field

from srnn_config import Parameters, parameter


@dataclass(frozen=True)
class GateParameters(Parameters):
    """What a segment must obey before it may move the arm."""

    max_age: float = parameter(
        0.5, unit='s', above=0.0, maximum=10.0,
        doc='Older segments are stale.',
    )
    max_knots: int = parameter(
        1000, minimum=2, maximum=100_000,
        doc='Most knots that a segment may have.',
    )
    min_step: float = parameter(
        0.001, unit='s', above=0.0, maximum=1.0,
        doc='Shortest time between two knots.',
    )
    half_width: float = parameter(
        0.30, unit='m', above=0.0, maximum=1.0,
        doc='Half the side of the square that the tip may move in.',
    )
    margin: float = parameter(
        0.005, unit='m', minimum=0.0, maximum=0.1,
        doc='Distance that every point of a segment keeps from the edge of the square.',
    )
    start_distance: float = parameter(
        0.010, unit='m', above=0.0, maximum=0.05,
        doc='Largest distance of the first knot from the reference that the segment joins.',
    )
    speed_limit: float = parameter(
        0.25, unit='m/s', above=0.0, maximum=0.5,
        doc='Largest speed anywhere on the path.',
    )
    acceleration_limit: float = parameter(
        3.0, unit='m/s^2', above=0.0, maximum=20.0,
        doc='Largest acceleration anywhere on the path; times the period it is also the '
        'largest step in velocity at the start.',
    )
    blend: float = parameter(
        0.3, unit='s', above=0.0, maximum=5.0,
        doc='Time in which a small offset at the start fades out.',
    )

    def check(self) -> None:
        """Refuse a margin that leaves no square."""
        if self.margin >= self.half_width:
            raise self.refuse('margin', self.margin, f'< half_width = {self.half_width:g}')


@dataclass(frozen=True)
class ContactParameters(Parameters):
    """When the arm counts as touching something."""

    force: float = parameter(
        10.0, unit='N', above=0.0, maximum=200.0,
        doc='Planar tip force above which the arm is in contact.',
    )
    rearm_force: float = parameter(
        5.0, unit='N', above=0.0, maximum=200.0,
        doc='Planar tip force below which the force rule is armed again after a contact.',
    )
    error: float = parameter(
        0.005, unit='m', above=0.0, maximum=0.1,
        doc='Planar tracking error above which the arm is in contact.',
    )
    samples: int = parameter(
        2, minimum=1, maximum=100,
        doc='Samples in a row that must agree.',
    )
    repeats: int = parameter(
        3, minimum=1, maximum=100,
        doc='Contacts at one place, within the window, that do not stop the arm until reset.',
    )
    window: float = parameter(
        2.0, unit='s', above=0.0, maximum=60.0,
        doc='Time in which contacts count as repeated.',
    )
    place: float = parameter(
        0.01, unit='m', above=0.0, maximum=0.2,
        doc='The tip has left the place of a contact once it is farther away than this.',
    )

    def check(self) -> None:
        """Refuse a hysteresis that is upside down."""
        if self.rearm_force > self.force:
            raise self.refuse('rearm_force', self.rearm_force, f'<= force = {self.force:g}')


@dataclass(frozen=True)
class LawParameters(Parameters):
    """How joint commands follow the reference."""

    lead: float = parameter(
        0.012, unit='s', minimum=0.0, maximum=0.1,
        doc='Time by which commands run ahead of where the measured tip should be.',
    )
    integral_gain: float = parameter(
        3.0, unit='1/s', minimum=0.0, maximum=50.0,
        doc='Rate at which the measured tip error is integrated into the command.',
    )
    integral_limit: float = parameter(
        0.008, unit='m', minimum=0.0, maximum=0.05,
        doc='Largest correction of the command on each axis.',
    )
    posture_gain: float = parameter(
        1.0, unit='1/s', minimum=0.0, maximum=20.0,
        doc='Rate at which motion that leaves the tip still draws the joints to home.',
    )
    damping: float = parameter(
        0.01, unit='m/rad', above=0.0, maximum=0.5,
        doc='Damping of the inverse of the Jacobian.',
    )
    tip_speed: float = parameter(
        0.5, unit='m/s', above=0.0, maximum=2.0,
        doc='Fastest that the commanded tip may move, corrections and freezes included.',
    )


@dataclass(frozen=True)
class LimitParameters(Parameters):
    """Bounds of the motion itself."""

    braking: float = parameter(
        1.5, unit='m/s^2', above=0.0, maximum=10.0,
        doc='Deceleration of a soft stop along the path.',
    )
    height_speed: float = parameter(
        0.02, unit='m/s', above=0.0, maximum=0.2,
        doc='Speed at which the tip approaches the height of the plane after the start.',
    )
    max_step: float = parameter(
        0.008, unit='s', above=0.0, maximum=0.1,
        doc='Longest time that one command may advance the motion.',
    )
    position_margin: float = parameter(
        0.035, unit='rad', minimum=0.0, maximum=0.5,
        doc='Distance that commands keep from the joint limits.',
    )
    slow_margin: float = parameter(
        0.087, unit='rad', above=0.0, maximum=1.0,
        doc='Nearer to a joint limit than this, motion towards it is slowed down.',
    )
    singular: float = parameter(
        0.05, unit='m/rad', minimum=0.0, maximum=1.0,
        doc='Smallest singular value of the Jacobian of the tip that is moved to.',
    )
    slow_singular: float = parameter(
        0.10, unit='m/rad', above=0.0, maximum=1.0,
        doc='Below this singular value motion towards smaller ones is slowed down.',
    )
    patience: float = parameter(
        0.020, unit='s', minimum=0.0, maximum=1.0,
        doc='Motion that has been hindered for this long, by joint limits, a singular posture, or '
        'limits of joint speed or torque, stops the arm.',
    )
    velocity_share: float = parameter(
        0.8, above=0.0, maximum=1.0,
        doc='Share of the joint velocity limits that commands may use.',
    )
    joint_divergence: float = parameter(
        0.2, unit='rad', above=0.0, maximum=1.0,
        doc='Difference of commanded and measured joint angle that is a fault.',
    )

    def check(self) -> None:
        """Refuse zones that are inside out."""
        if self.slow_margin <= self.position_margin:
            raise self.refuse(
                'slow_margin', self.slow_margin, f'> position_margin = {self.position_margin:g}'
            )
        if self.slow_singular <= self.singular:
            raise self.refuse(
                'slow_singular', self.slow_singular, f'> singular = {self.singular:g}'
            )


@dataclass(frozen=True)
class WatchParameters(Parameters):
    """What a joint state must obey to be believed."""

    gap: float = parameter(
        0.02, unit='s', above=0.0, maximum=0.5,
        doc='Missing joint states excuse a jump of the angles for no longer than this.',
    )
    position_tolerance: float = parameter(
        0.02, unit='rad', minimum=0.0, maximum=0.5,
        doc='A measured angle this far beyond the joint limits is not true.',
    )
    motion: float = parameter(
        0.0005, unit='rad', above=0.0, maximum=0.1,
        doc='Angles must change once the command has moved on by more than this.',
    )
    repeats: int = parameter(
        2, minimum=1, maximum=100,
        doc='Joint states in a row that say the same until the measurement counts as frozen.',
    )


@dataclass(frozen=True)
class TrackerParameters(Parameters):
    """All parameters of the tracker."""

    period: float = parameter(
        0.004, unit='s', above=0.0, maximum=0.1,
        doc='Nominal time between two joint states, and between two commands.',
    )
    gate: GateParameters = field(default_factory=GateParameters)
    contact: ContactParameters = field(default_factory=ContactParameters)
    law: LawParameters = field(default_factory=LawParameters)
    limits: LimitParameters = field(default_factory=LimitParameters)
    watch: WatchParameters = field(default_factory=WatchParameters)

    def check(self) -> None:
        """Refuse a watch whose gap is shorter than the time between two joint states."""
        if self.watch.gap < self.period:
            raise self.refuse('watch.gap', self.watch.gap, f'>= period = {self.period:g}')
