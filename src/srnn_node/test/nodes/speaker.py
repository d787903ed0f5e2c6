# SPDX-License-Identifier: Apache-2.0
"""A node that counts on its ticks and takes leave when it is deactivated."""

from dataclasses import dataclass
import sys
import time

from std_msgs.msg import Float64MultiArray

from srnn_config import Parameters, parameter
from srnn_msgs_py.health import Health
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.rate import RateKeeper
from srnn_node.run import run

FAREWELL = -1.0


@dataclass(frozen=True)
class SpeakerParameters(Parameters):
    """Parameters of the speaker."""

    rate: float = parameter(50.0, unit='Hz', above=0.0, maximum=1000.0, doc='Ticks per second.')
    dies_after: int = parameter(
        0, minimum=0, doc='Ticks with a listener after which it breaks; 0 for never.'
    )


class Speaker(WorkspaceNode):
    """Counts on a topic."""

    PARAMETERS = SpeakerParameters

    def __init__(self):
        super().__init__('speaker')

    def configure(self, parameters):
        self.parameters = parameters
        self.publisher = self.advertise('forward_position_controller/commands')

    def activate(self):
        self.listened_to = 0
        self.rate = RateKeeper(1.0 / self.parameters.rate, time.monotonic())

    def deactivate(self):
        self.say(FAREWELL)

    def seconds_to_tick(self):
        return self.rate.seconds_to_tick(time.monotonic())

    def on_tick(self):
        if self.rate.take(time.monotonic()):
            self.say(float(self.rate.taken))
        self.listened_to += self.publisher.get_subscription_count() > 0
        if self.listened_to and self.listened_to == self.parameters.dies_after:
            raise ValueError('dies as it was told')

    def health(self):
        return Health(values={'skipped': 0})

    def say(self, number):
        self.publisher.publish(Float64MultiArray(data=[number]))


if __name__ == '__main__':
    sys.exit(run(Speaker))
