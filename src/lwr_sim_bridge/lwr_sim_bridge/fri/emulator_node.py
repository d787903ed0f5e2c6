# SPDX-License-Identifier: Apache-2.0
"""The FRI emulator: the controller of an LWR 4+ on UDP, the MuJoCo arm behind it."""

from collections.abc import Sequence
from dataclasses import dataclass, field
import time

import numpy as np
from std_srvs.srv import Trigger

from lwr_description import Mount
from lwr_sim_bridge.errors import SimulationError
from lwr_sim_bridge.fri.controller import COMMAND, FriController
from lwr_sim_bridge.fri.krl_program import SCHEMES, KrlProgram
from lwr_sim_bridge.fri.parameters import ControllerParameters
from lwr_sim_bridge.fri.udp_link import UdpLink
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.ros.scene_topics import SceneTopics
from lwr_sim_bridge.simulated_arm import TICK, SimulatedArm
from srnn_config import Parameters, parameter
from srnn_config.scene import load_scene
from srnn_msgs_py.health import Health, HealthLevel
from srnn_node.errors import NodeError
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.run import run

PRIORITY = 70
"""SCHED_FIFO priority to ask for: a real controller waits for nobody on this machine."""

QUALITIES = ('UNACCEPTABLE', 'BAD', 'OK', 'PERFECT')

WORK = 0.2
"""Share of a cycle in which the packet must go out; a later one moves all that follow.

The arm's time slows down instead. A controller that hurried to make up for its own delay would
leave its peer no time for an answer.
"""

TRUTH_S = 0.02
"""The true contact force goes out this often [s]."""


@dataclass(frozen=True)
class EmulatorParameters(Parameters):
    """Parameters of the FRI emulator node."""

    scene: str = parameter(doc='Scene file with obstacles, sensor noise and start.')
    seed: int = parameter(0, minimum=0, doc='Seed of the sensor noise and of the link faults.')
    cycle: int = parameter(
        5, unit='ms', minimum=1, maximum=100, doc='Time between two packets, argument of friOpen.'
    )
    handshake: str = parameter(
        'ros_control', choices=tuple(SCHEMES), doc='Which KRL program runs.'
    )
    driver: str = parameter('127.0.0.1', doc='Address of the driver.')
    port: int = parameter(49938, minimum=1, maximum=65535, doc='UDP port of the driver.')
    mount: Mount = field(default_factory=Mount)
    arm: ArmParameters = field(default_factory=ArmParameters)
    controller: ControllerParameters = field(default_factory=ControllerParameters)


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
        self.create_service(Trigger, '~/acknowledge', self._on_acknowledge)

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
        controller, statistics = self._controller, self._controller.statistics
        commanding = controller.state == COMMAND
        values = {
            'state': 'COMMAND' if commanding else 'MONITOR',
            'quality': QUALITIES[controller.quality],
            'cycles': self._cycles,
            'overruns': self._overruns,
            'answer_rate': statistics.answer_rate,
            'latency_ms': 1e3 * statistics.latency,
            'misses': statistics.misses,
            'late': controller.late,
            'rejected': controller.rejected,
        }
        if controller.message:
            return Health(HealthLevel.ERROR, controller.message, values)
        words = 'command mode' if commanding else 'monitor mode'
        return Health(HealthLevel.OK, words, values)

    def _on_acknowledge(
        self, _: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        response.success = True
        response.message = f'acknowledged: {self._controller.message or "no message"}'
        self._controller.acknowledge()
        return response


def main(args: Sequence[str] | None = None) -> int:
    """Run the FRI emulator as a process."""
    return run(EmulatorNode, args, priority=PRIORITY)


if __name__ == '__main__':
    raise SystemExit(main())
