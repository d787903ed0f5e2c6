# SPDX-License-Identifier: Apache-2.0
"""What the driver and the KRL program on the controller tell each other to start and stop.

Published programs use one of two schemes. Indices count from 0; KRL counts from 1.
"""

from dataclasses import dataclass

from lwr_fri_driver.core.datagram import EXCHANGE, Exchange
from lwr_fri_driver.core.words import Control

STRATEGY_NUMBERS = {Control.POSITION: 10, Control.JOINT_IMPEDANCE: 30}
"""`$stiffness.strategy` of KRL for the laws that the driver can ask for."""


@dataclass(frozen=True)
class Handshake:
    """Where a KRL program looks for the strategy and for the wish to start.

    Attributes:
        strategy_index: int of the command with the strategy, applied when command mode starts.
        wish_index: int of the command with the wish.
        start: wish to go to command mode.
        stop: wish to leave it, and to stay out of it.

    """

    strategy_index: int
    wish_index: int
    start: int
    stop: int

    def exchange(self, control: Control, wanted: bool) -> Exchange:
        """Return what to tell the program.

        Args:
            control: law that command mode is to have.
            wanted: whether command mode is.

        """
        ints = [0] * EXCHANGE
        ints[self.strategy_index] = STRATEGY_NUMBERS[control]
        ints[self.wish_index] = self.start if wanted else self.stop
        return Exchange(ints=tuple(ints))


HANDSHAKES = {
    'ros_control': Handshake(strategy_index=0, wish_index=1, start=1, stop=0),
    'fri_library': Handshake(strategy_index=14, wish_index=15, start=10, stop=20),
}
"""By name: `ros_control.src` of CentroEPiaggio, and `FRIControl.src` of the FRI library."""
