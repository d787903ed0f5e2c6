# SPDX-License-Identifier: Apache-2.0
"""`srnn pause` and `srnn resume`: a running graph, whoever has started it."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
import os
from pathlib import Path
import sys

from rclpy.node import Node

from srnn_bringup.arms import HOLDING
from srnn_bringup.config import ROOT
from srnn_bringup.console import Console
from srnn_bringup.environment import DOMAIN_ID
from srnn_bringup.errors import BringupError, ChoiceError, Interrupted, TransitionError
from srnn_bringup.exit_codes import DONE, FAILED, by_signal
from srnn_bringup.graph import NAMES, complete
from srnn_bringup.lifecycle_client import LifecycleClient
from srnn_bringup.live_graph import ACTIVATE_S, DEACTIVATE_S
from srnn_bringup.neighbours import neighbours
from srnn_bringup.peer_profile import talking_to
from srnn_bringup.peers import Peer
from srnn_bringup.pump import Pump
from srnn_bringup.session import session
from srnn_bringup.standstill import Standstill
from srnn_node.signals import StopRequest

LOOK_S = 4.0
"""A node that is not seen by then does not run in this domain [s]."""

ANSWER_S = 8.0
REST_S = 10.0
"""No segment takes longer than this to execute [s]."""


class RunningGraph:
    """The nodes that run in this domain.

    Attributes:
        clients: one for each of them, in the order of their bring-up.

    """

    def __init__(
        self, clients: Sequence[LifecycleClient], pump: Pump, standstill: Standstill
    ) -> None:
        """Take what was found."""
        self.clients = clients
        self._pump = pump
        self._standstill = standstill

    def pause(self, say: Callable[[str], None]) -> None:
        """Deactivate the planner, wait until the arm rests, deactivate what moves it.

        Raises:
            BringupError: a node did not do its part; the others have.

        """
        problems = []
        for client in reversed(self.clients):
            try:
                self._pause(client, say)
            except Interrupted:
                raise
            except BringupError as problem:
                problems.append(problem)
        if problems:
            raise problems[0]

    def resume(self, say: Callable[[str], None]) -> None:
        """Activate what is inactive, the arm first and the planner last.

        Raises:
            BringupError: a node did not do its part; those after it were left as they are.

        """
        for client in self.clients:
            state = client.state(self._pump, ANSWER_S)
            if state == 'active':
                say(f'{client.name} is active already')
            elif state == 'inactive':
                client.change('activate', self._pump, ACTIVATE_S)
                say(f'{client.name} resumed')
            else:
                raise TransitionError(f'{client.name} is {state}: it has nothing to resume')

    def _pause(self, client: LifecycleClient, say: Callable[[str], None]) -> None:
        if client.name in HOLDING:
            return
        state = client.state(self._pump, ANSWER_S)
        if state != 'active':
            say(f'{client.name} is {state} already')
            return
        client.change('deactivate', self._pump, DEACTIVATE_S)
        say(f'{client.name} paused')
        if client.name == 'planner' and any(c.name == 'tracker' for c in self.clients):
            # So that the adapter still hears how the last segment ended.
            self._pump.until(self._standstill, REST_S)


def run_pause(peers: Sequence[Peer], keystore: Path | None, namespace: str) -> int:
    """Pause the graph of this domain and namespace; return the exit code."""
    return _run('pause', RunningGraph.pause, peers, keystore, namespace)


def run_resume(peers: Sequence[Peer], keystore: Path | None, namespace: str) -> int:
    """Resume the graph of this domain and namespace; return the exit code."""
    return _run('resume', RunningGraph.resume, peers, keystore, namespace)


def _run(
    command: str,
    action: Callable[[RunningGraph, Callable[[str], None]], None],
    peers: Sequence[Peer],
    keystore: Path | None,
    namespace: str,
) -> int:
    with talking_to(peers), StopRequest() as stop:
        try:
            with running_graph(f'srnn_{command}', stop, keystore, namespace) as graph:
                action(graph, Console(sys.stdout).note)
            return DONE
        except Interrupted as wish:
            return by_signal(str(wish))
        except BringupError as error:
            print(f'srnn {command}: {error}', file=sys.stderr, flush=True)
            return FAILED


@contextmanager
def running_graph(
    name: str, stop: StopRequest, keystore: Path | None = None, namespace: str = ROOT
) -> Iterator[RunningGraph]:
    """Find the nodes of a graph that run in this domain.

    Args:
        name: what to be called there.
        stop: tells when the user wants to stop.
        keystore: keystore that protects the graph, None for none.
        namespace: absolute ROS namespace of the graph.

    Raises:
        ChoiceError: there are none; the message says in which namespaces there are.

    """

    def guard() -> None:
        if stop.name is not None:
            raise Interrupted(stop.name)

    with session(name, guard, keystore, namespace) as (node, pump):
        standstill = Standstill(node)
        pump.until(lambda: complete(neighbours(node)), LOOK_S)
        seen = set(neighbours(node))
        if not seen & set(NAMES):
            raise ChoiceError(_nobody(node))
        clients = [LifecycleClient(node, other, lambda: '') for other in NAMES if other in seen]
        yield RunningGraph(clients, pump, standstill)


def _nobody(node: Node) -> str:
    """Return that there is no graph here, and where there is one."""
    domain = os.environ.get(DOMAIN_ID) or '0'
    here = node.get_namespace()
    where = '' if here == ROOT else f' in namespace {here}'
    seen = node.get_node_names_and_namespaces()
    others = sorted({namespace for name, namespace in seen if name in NAMES})
    hint = f'; there is one in namespace {" and ".join(others)}' if others else ''
    return f'no graph in {DOMAIN_ID} = {domain}{where}: start one with `srnn up`{hint}'
