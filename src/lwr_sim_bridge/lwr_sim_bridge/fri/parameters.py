# SPDX-License-Identifier: Apache-2.0
"""What can be set on the emulated controller, validated once."""

from dataclasses import dataclass, field

from srnn_config import Parameters, parameter


@dataclass(frozen=True)
class LinkFaultParameters(Parameters):
    """What the network does to packets, each way; nothing unless set."""

    loss: float = parameter(0.0, minimum=0.0, maximum=1.0, doc='Share of packets that vanish.')
    duplicates: float = parameter(
        0.0, minimum=0.0, maximum=1.0, doc='Share of packets that arrive twice.'
    )
    jitter: float = parameter(
        0.0, unit='s', minimum=0.0, maximum=1.0,
        doc='Packets are late by up to this, each by its own share: they overtake each other.',
    )


@dataclass(frozen=True)
class PatienceParameters(Parameters):
    """How bad a link the controller bears. The numbers of the real one are not published."""

    extrapolated: int = parameter(
        5, minimum=0, maximum=100,
        doc='Cycles in a row without an answer that are bridged in command mode.',
    )
    cap: int = parameter(
        20, minimum=1, maximum=1000,
        doc='Answers on account at most; each one adds one, each missing one takes one.',
    )
    perfect: int = parameter(
        16, minimum=1, maximum=1000, doc='The quality is PERFECT with at least so many.'
    )
    ok: int = parameter(
        11, minimum=1, maximum=1000,
        doc='The quality is OK with at least so many; with fewer command mode ends.',
    )
    mirror_tolerance: float = parameter(
        0.001, unit='rad', minimum=0.0, maximum=0.1,
        doc='Command mode begins only from a command this near to where the arm is held.',
    )

    def check(self) -> None:
        """Refuse levels that cannot be reached one after the other."""
        if not self.ok <= self.perfect <= self.cap:
            raise self.refuse('perfect', self.perfect, f'from ok = {self.ok} to cap = {self.cap}')


@dataclass(frozen=True)
class ControllerParameters(Parameters):
    """How the emulated controller behaves, whoever it talks to."""

    velocity_share: float = parameter(
        1.0, above=0.0, maximum=1.0,
        doc='Share of the joint velocity limits that is permitted, argument of friStart.',
    )
    patience: PatienceParameters = field(default_factory=PatienceParameters)
    faults: LinkFaultParameters = field(default_factory=LinkFaultParameters)
