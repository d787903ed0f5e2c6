# SPDX-License-Identifier: Apache-2.0
"""What both datagrams begin with."""

from dataclasses import dataclass

from lwr_fri_driver.core.layout import wire

EXCHANGE = 16
"""Numbers of each kind that a KRL program and the driver exchange."""


@dataclass(frozen=True, slots=True)
class Head:
    """Who answers what.

    Attributes:
        sequence: the sender's own counter, one more for every packet, wraps at 65536.
        reflected: the last counter that came from the other side.
        size: of the datagram [bytes].
        datagram_id: kind and version.

    """

    sequence: int = wire(0, 'H')
    reflected: int = wire(2, 'H')
    size: int = wire(4, 'H')
    datagram_id: int = wire(6, 'H')


@dataclass(frozen=True, slots=True)
class Exchange:
    """What a KRL program and the driver tell each other; KRL counts from 1, this from 0.

    Attributes:
        reals: (16,) `$FRI_TO_REA`, in commands `$FRI_FRM_REA`.
        ints: (16,) `$FRI_TO_INT`, in commands `$FRI_FRM_INT`.
        bools: `$FRI_TO_BOOL`, in commands `$FRI_FRM_BOOL`; bit 0 is [1].
        fill: nothing.

    """

    reals: tuple[float, ...] = wire(8, 'f', EXCHANGE)
    ints: tuple[int, ...] = wire(72, 'i', EXCHANGE)
    bools: int = wire(136, 'H')
    fill: int = wire(138, 'H')
