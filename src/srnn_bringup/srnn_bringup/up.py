# SPDX-License-Identifier: Apache-2.0
"""`srnn up`: the graph, until the user has had enough."""

from collections.abc import Collection, Sequence
from pathlib import Path
import sys

from srnn_bringup.config import Configuration
from srnn_bringup.console import Console
from srnn_bringup.errors import BringupError, Interrupted
from srnn_bringup.exit_codes import DONE, FAILED
from srnn_bringup.live_graph import LiveGraph
from srnn_bringup.peer_profile import talking_to
from srnn_bringup.peers import Peer
from srnn_bringup.restarts import Restarts
from srnn_bringup.viewer import viewing
from srnn_node.signals import StopRequest

WARNINGS_S = 1.0
"""How often it is looked at what nodes warn of [s]."""


def run_up(
    configuration: Configuration,
    names: Collection[str] = (),
    peers: Sequence[Peer] = (),
    bag: Path | None = None,
    view: int | None = None,
) -> int:
    """Start the graph and keep it up until a signal comes; a node that dies is started anew.

    Args:
        configuration: what the nodes are told.
        names: which nodes; all if empty.
        peers: other hosts, where the rest of the graph runs.
        bag: new directory to record to; None to record nothing.
        view: port of a page that shows the graph; None for no page.

    Returns:
        Exit code: 0 when stopped by the user, 1 after a failure.

    """
    console = Console(sys.stdout)
    with talking_to(peers), StopRequest() as stop:
        try:
            with (
                viewing(configuration, view, console.note),
                LiveGraph(configuration, stop, console.note, Restarts(), names, bag) as graph,
            ):
                graph.configure()
                graph.activate()
                processes = ', '.join(f'{name} ({pid})' for name, pid in graph.pids.items())
                console.note(f'up: {processes}; Ctrl-C stops the graph')
                while True:
                    graph.pump.until(lambda: False, WARNINGS_S)
                    for warning in graph.warnings():
                        console.note(warning)
        except Interrupted as wish:
            console.note(f'stopped by {wish}')
            return DONE
        except BringupError as error:
            print(f'srnn up: {error}', file=sys.stderr, flush=True)
            return FAILED
