# SPDX-License-Identifier: Apache-2.0
"""`srnn up`: the graph, until the user has had enough."""

import sys

from srnn_bringup.config import Configuration
from srnn_bringup.console import Console
from srnn_bringup.errors import BringupError, Interrupted
from srnn_bringup.live_graph import LiveGraph
from srnn_bringup.restarts import Restarts
from srnn_node.signals import StopRequest


def run_up(configuration: Configuration) -> int:
    """Start the graph and keep it up until a signal comes; a node that dies is started anew.

    Returns:
        Exit code: 0 when stopped by the user, 1 after a failure.

    """
    console = Console(sys.stdout)
    with StopRequest() as stop:
        try:
            with LiveGraph(configuration, stop, console.note, Restarts()) as graph:
                graph.configure()
                graph.activate()
                processes = ', '.join(f'{name} ({pid})' for name, pid in graph.pids.items())
                console.note(f'up: {processes}; Ctrl-C stops the graph')
                while True:
                    graph.pump.turn()
        except Interrupted as wish:
            console.note(f'stopped by {wish}')
            return 0
        except BringupError as error:
            print(f'srnn up: {error}', file=sys.stderr, flush=True)
            return 1
