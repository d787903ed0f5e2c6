# SPDX-License-Identifier: Apache-2.0
"""The live view: serves a local web page that shows the graph of this domain."""

from collections.abc import Sequence
from dataclasses import dataclass, field
import os
import socket
import sys
import time

import rclpy
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
import viser

from lwr_description import Mount
from srnn_config import ConfigError, Parameters, parameter
from srnn_config.scene import load_scene
from srnn_node.command_line import read_command_line, usage
from srnn_node.parameters import declare_parameters
from srnn_node.signals import StopRequest
from srnn_view.errors import PortError, ViewError
from srnn_view.live_run import LiveRun
from srnn_view.panel import Panel
from srnn_view.ros.ears import Ears
from srnn_view.stage import Stage

NAME = 'view'

HOST = '127.0.0.1'
"""Nobody but this machine is shown anything: the page asks for no password."""

PERIOD_S = 0.1
NICENESS = 10
"""Whatever moves the arm comes first."""


@dataclass(frozen=True)
class ViewParameters(Parameters):
    """Parameters of the view."""

    scene: str = parameter(doc='Scene file with the obstacles to be drawn.')
    obstacles: bool = parameter(True, doc='Draw the obstacles; there are none around a mock arm.')
    port: int = parameter(8080, minimum=0, maximum=65535, doc='TCP port of the page; 0: any.')
    mount: Mount = field(default_factory=Mount)


def main(args: Sequence[str] | None = None) -> int:
    """Run the view as a process."""
    command_line = list(sys.argv if args is None else args)
    words = usage(__doc__ or NAME, ViewParameters)
    code = read_command_line(command_line, NAME, words)
    if code is not None:
        return code
    os.nice(NICENESS)
    rclpy.init(args=command_line, signal_handler_options=SignalHandlerOptions.NO)
    try:
        with StopRequest() as stop:
            # What is heard is fetched: the node is served by no executor.
            node = Node(NAME, enable_rosout=False, start_parameter_services=False)
            try:
                _show(node, stop)
            except (ConfigError, ViewError) as error:
                print(f'{error}; try --help', file=sys.stderr, flush=True)
                return 1
    finally:
        rclpy.try_shutdown()
    return 0


def _show(node: Node, stop: StopRequest) -> None:
    parameters = declare_parameters(node, ViewParameters)
    obstacles = load_scene(parameters.scene).obstacles if parameters.obstacles else ()
    run = LiveRun()
    ears = Ears(node, run, parameters.mount.description.joints)
    server = viser.ViserServer(HOST, _free(parameters.port), 'srnn', verbose=False)
    stage = Stage(server, parameters.mount, obstacles)
    panel = Panel(server.gui)
    print(f'live view: http://{HOST}:{server.get_port()}', flush=True)
    due = time.monotonic()
    while stop.name is None:
        ears.listen()
        if server.get_clients():
            changed = run.changed()
            with server.atomic():
                stage.draw(run, changed)
                panel.draw(run, changed)
        due = max(due + PERIOD_S, time.monotonic())
        time.sleep(max(due - time.monotonic(), 0.0))
    server.stop()


def _free(port: int) -> int:
    """Return the port, an unused one for 0.

    Raises:
        PortError: somebody else has it.

    """
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((HOST, port))
        except OSError as error:
            raise PortError(
                f'{NAME}: port = {port}: {error.strerror}; choose another, or 0'
            ) from error
        return int(probe.getsockname()[1])


if __name__ == '__main__':
    raise SystemExit(main())
