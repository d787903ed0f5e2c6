# SPDX-License-Identifier: Apache-2.0
"""The FRI emulator: the controller of an LWR 4+ on UDP, the MuJoCo arm behind it."""

from collections.abc import Sequence
import time

import numpy as np

from lwr_sim_bridge.errors import SimulationError
from lwr_sim_bridge.fri.controller import FriController
from lwr_sim_bridge.fri.emulator_health import emulator_health
from lwr_sim_bridge.fri.emulator_parameters import EmulatorParameters
from lwr_sim_bridge.fri.krl_program import KrlProgram
from lwr_sim_bridge.fri.udp_link import UdpLink
from lwr_sim_bridge.ros.scene_topics import SceneTopics
from lwr_sim_bridge.simulated_arm import TICK, SimulatedArm
from srnn_config.scene import load_scene
from srnn_msgs_py.health import Health
from srnn_node import trigger
from srnn_node.errors import NodeError
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.run import run

PRIORITY = 70
"""SCHED_FIFO priority to ask for: a real controller waits for nobody on this machine."""

WORK = 0.2
"""Share of a cycle in which the packet must go out; a later one moves all that follow.

The arm's time slows down instead. A controller that hurried to make up for its own delay would
leave its peer no time for an answer.
"""

TRUTH_S = 0.02
"""The true contact force goes out this often [s]."""


class EmulatorNode(WorkspaceNode):
    """Sends measurements while active, as a controller does whose KRL program runs."""

    PARAMETERS = EmulatorParameters

    def __init__(self) -> None:
        """Create the node, unconfigured."""
        super().__init__('fri_emulator')

    def configure(self, parameters: EmulatorParameters) -> None:
        """Build the simulated world, open the socket, connect topics and services."""
        scene = load_scene(parameters.scene)
        self._arm = SimulatedArm(
            parameters.arm, parameters.mount, scene, np.random.default_rng([parameters.seed, 2])
        )
        self._controller = FriController(
            self._arm, parameters.mount, parameters.cycle, KrlProgram(parameters.handshake),
            parameters.controller,
        )
        faults = np.random.default_rng([parameters.seed, 3])
        address = parameters.driver, parameters.port
        try:
            self._link = UdpLink(address, parameters.controller.faults, faults)
        except OSError as error:
            raise NodeError(f'driver = {parameters.driver!r}: {error.strerror}') from error
        self._period = TICK * parameters.cycle
        self._cycles_per_truth = max(round(TRUTH_S / self._period), 1)
        self._cycles = 0
        self._state = self._controller.state
        self._topics = SceneTopics(self, len(scene.obstacles), lambda: self._arm)
        trigger.offer(self, 'acknowledge', self._acknowledge)

    def activate(self) -> None:
        """Let time run from now on."""
        self._due = time.monotonic()
        self._overruns = 0

    def cleanup(self) -> None:
        """Close the socket."""
        self._link.close()

    def seconds_to_tick(self) -> float | None:
        """Return the time until the next cycle is due, or a late packet [s]."""
        return min(self._due, self._link.next) - time.monotonic()

    def on_tick(self) -> None:
        """End a cycle and begin the next one.

        Raises:
            NodeError: the physics has gone wrong; there is no arm to report any more.

        """
        self._link.flush()
        late = time.monotonic() - self._due
        if late < 0.0:
            return
        self._overruns += late > self._period
        for data, arrival in self._link.receive():
            self._controller.receive(data, arrival)
        try:
            self._controller.advance()
        except SimulationError as error:
            raise NodeError(str(error)) from error
        self._send(self._controller.measure())
        self._cycles += 1
        if self._cycles % self._cycles_per_truth == 0:
            self._topics.report(self.get_clock().now().nanoseconds)
        if self._controller.state != self._state:  # Between two reports it may change twice.
            self._state = self._controller.state
            self.report_health()

    def _send(self, packet: bytes) -> None:
        now = time.monotonic()
        self._link.send(packet)
        self._controller.sent(now)
        late = now - self._due - WORK * self._period
        self._due += self._period + (late if late > 0.0 else 0.0)

    def health(self) -> Health:
        """Report the state of the controller, and what it thinks of the link."""
        if not self.active:
            return Health()
        return emulator_health(self._controller, self._cycles, self._overruns)

    def _acknowledge(self) -> str:
        message = self._controller.message or 'no message'
        self._controller.acknowledge()
        return f'acknowledged: {message}'


def main(args: Sequence[str] | None = None) -> int:
    """Run the FRI emulator as a process."""
    return run(EmulatorNode, args, priority=PRIORITY)


if __name__ == '__main__':
    raise SystemExit(main())
