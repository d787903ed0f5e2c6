# SPDX-License-Identifier: Apache-2.0
"""The process that answers the controller; the node starts it and hands it two sockets."""

from collections.abc import Sequence
from dataclasses import dataclass, field
import gc
import json
import signal
import socket
import sys

from lwr_description import Kinematics, Mount
from lwr_fri_driver.core.connection import Connection
from lwr_fri_driver.core.parameters import DriverParameters
from lwr_fri_driver.core.rehearsal import rehearse
from lwr_fri_driver.core.reports import MAX_SIZE
from lwr_fri_driver.udp_loop import UdpLoop
from srnn_config import Parameters, build
from srnn_node.realtime import request_realtime

PRIORITY = 60
"""SCHED_FIFO priority to ask for: above the nodes, which this process must not wait for."""


@dataclass(frozen=True)
class LoopParameters(Parameters):
    """What the process is told in the first message of the node."""

    mount: Mount = field(default_factory=Mount)
    driver: DriverParameters = field(default_factory=DriverParameters)


def main(args: Sequence[str] | None = None) -> int:
    """Answer the controller until the node is gone and the arm is out of command mode.

    Args:
        args: file descriptors of the UDP socket and of the socket of the node.

    """
    udp_fd, node_fd = map(int, sys.argv[1:] if args is None else args)
    # Signals to the whole process group are for the node, which leaves command mode first.
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    udp, node = socket.socket(fileno=udp_fd), socket.socket(fileno=node_fd)
    parameters = build(LoopParameters, json.loads(node.recv(MAX_SIZE)), 'the first message')
    gravity = Kinematics(parameters.mount).gravity
    rehearse(parameters.driver, gravity)
    connection = Connection(parameters.driver, gravity)
    scheduling = request_realtime(PRIORITY)
    loop = UdpLoop(udp, node, connection, parameters.driver, scheduling.words)
    # Nothing here makes cycles of references, so nothing is lost without the collector.
    gc.collect()
    gc.freeze()
    gc.disable()
    while not loop.finished:
        loop.turn()
    return 0


if __name__ == '__main__':
    raise SystemExit(main())
