# SPDX-License-Identifier: Apache-2.0
"""The running graph: its processes and the way through their lifecycles."""

from collections.abc import Callable, Collection, Sequence
from contextlib import ExitStack, suppress
from functools import partial
import os
from pathlib import Path
import re
import sys
import tempfile
import time
from types import TracebackType
from typing import Self

from srnn_bringup import bag_attachments
from srnn_bringup.bag_recorder import record
from srnn_bringup.config import ROOT, Configuration
from srnn_bringup.dds_security.enclaves import COMMAND
from srnn_bringup.environment import DOMAIN_ID, graph_environment, security_arguments
from srnn_bringup.errors import (
    BringupError,
    ChoiceError,
    Interrupted,
    NodeDiedError,
    TransitionError,
)
from srnn_bringup.graph import access, chosen, write_parameters
from srnn_bringup.lifecycle_client import LifecycleClient
from srnn_bringup.neighbours import neighbours
from srnn_bringup.node_description import NodeDescription
from srnn_bringup.paused_nodes import PausedNodes
from srnn_bringup.restarts import Restarts
from srnn_bringup.session import session
from srnn_bringup.supervisor import Command, Death, Supervisor
from srnn_node.signals import StopRequest

CONFIGURE_S = 180.0
"""The first configuration on a machine compiles the kernels [s]."""

ACTIVATE_S = 10.0
DEACTIVATE_S = 4.0

_LINE = r'\](?: \[[^]]*\])* ?:? ?(.*)$'
_ERROR_LINE = re.compile(rf'^\[(?:ERROR|FATAL){_LINE}')
_WARNING_LINE = re.compile(rf'^\[(?:WARN|ERROR|FATAL){_LINE}')


class LiveGraph:
    """Nodes as processes; as a context manager it takes down whatever it brought up.

    Attributes:
        node: node of this process, for whoever wants to listen.
        pump: handles events; raises `Interrupted` or `NodeDiedError`.
        names: names of the nodes in the order of their bring-up.

    """

    def __init__(
        self,
        configuration: Configuration,
        stop: StopRequest,
        say: Callable[[str], None],
        restarts: Restarts | None = None,
        names: Collection[str] = (),
        bag: Path | None = None,
    ) -> None:
        """Start nothing yet.

        Args:
            configuration: what the nodes are told.
            stop: tells when the user wants to stop.
            say: told in words what happens.
            restarts: when to start active nodes anew that have died; None: the graph is
                at its end then.
            names: which nodes; all if empty.
            bag: new directory to record to; None to record nothing.

        Raises:
            ChoiceError: one of them is not in this graph.

        """
        self._restarts = restarts
        self._configuration = configuration
        self._stop = stop
        self._say = say
        self._stack = ExitStack()
        self._active: list[LifecycleClient] = []
        self._chosen = names
        self._bag = bag
        self.names = tuple(node.name for node in chosen(configuration, names))

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            self._start(stack)
            self._stack = stack.pop_all()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._say('stopping')
        with self._stack:
            self._deactivate()

    @property
    def pids(self) -> dict[str, int]:
        """Process ids of the nodes by name."""
        return self._supervisor.pids

    def configure(self) -> None:
        """Configure every node; nothing moves yet.

        Raises:
            ChoiceError: the domain already has such a graph.
            BringupError: a node is not there, or refuses.

        """
        for client in self._clients:
            self._say(f'configuring {client.name}')
            try:
                client.change('configure', self.pump, CONFIGURE_S)
            except TransitionError:
                # A node that has just started has no other reason than an error of its own.
                if not self._last_error(client.name):
                    self._refuse_namesakes([client.name])
                raise
        seen = neighbours(self.node)
        self._refuse_namesakes([name for name in self.names if seen.count(name) > 1])

    def activate(self) -> None:
        """Activate every node, the arm first and the planner last."""
        self._say(f'activating {", ".join(self.names)}')
        for client in self._clients:
            client.change('activate', self.pump, ACTIVATE_S)
            self._active.append(client)

    def warnings(self) -> list[str]:
        """Return what nodes have warned of since this was asked last, with their names."""
        return [
            f'{name}: {match[1]}'
            for name in self.names
            for line in self._supervisor.new_lines(name)
            if (match := _WARNING_LINE.match(line))
        ]

    def restart(self, name: str) -> None:
        """Start a node that has ended anew; it goes through its lifecycle by itself.

        Its services cannot be used for that: for a while a request may still go to the
        process that has died. One that was paused stays inactive.

        Raises:
            NodeDiedError: it cannot be started.

        """
        description = self._descriptions[self.names.index(name)]
        paused = name in self._pauses.paused
        self._supervisor.start(self._command(description, autostart=True, paused=paused))

    def _start(self, stack: ExitStack) -> None:
        directory = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix='srnn_')))
        self._descriptions = chosen(self._configuration, self._chosen, directory)
        self._files = write_parameters(
            self._descriptions, directory, **access(self._configuration)
        )
        self._say(f'starting {", ".join(self.names)}')
        # Before this process has the threads of the middleware, it may fork safely.
        self._supervisor = stack.enter_context(Supervisor(directory))
        for description in self._descriptions:
            self._supervisor.start(self._command(description))
        keystore, namespace = self._configuration.keystore, self._configuration.namespace
        self.node, self.pump = stack.enter_context(
            session(COMMAND, self._guard, keystore, namespace)
        )
        if self._bag is not None:
            recorder = record(self.node, self._bag, self._configuration.remappings)
            stack.callback(lambda: self._say(recorder.words()))
            stack.enter_context(recorder)
            recorder.attach(bag_attachments.of_run(self._configuration, self._files))
        self._pauses = PausedNodes(self.node, self.names)
        self._clients = [
            LifecycleClient(self.node, name, partial(self._last_error, name))
            for name in self.names
        ]

    def _command(
        self, description: NodeDescription, autostart: bool = False, paused: bool = False
    ) -> Command:
        told = self._configuration
        return command(
            description, self._files[description.name], told.keystore, autostart, paused,
            namespace=told.namespace, remappings=told.remappings,
        )  # fmt: skip

    def _deactivate(self) -> None:
        pump = self.pump.unguarded()
        for client in reversed(self._active):
            # Whatever goes wrong here, the process is stopped next.
            with suppress(BringupError):
                alive = self._supervisor.alive(client.name)
                if alive and client.name not in self._pauses.paused:
                    client.change('deactivate', pump, DEACTIVATE_S)
        self._active.clear()

    def _guard(self) -> None:
        for death in self._supervisor.deaths():
            self._mourn(death)
        if self._stop.name is not None:
            raise Interrupted(self._stop.name)
        if self._restarts is not None:
            for name in self._restarts.due(time.monotonic()):
                self.restart(name)

    def _mourn(self, death: Death) -> None:
        """Have a dead node started anew, or give up."""
        if self._restarts is None or len(self._active) < len(self.names):
            raise NodeDiedError(death.report())
        if death.code >= 0:
            self._pauses.ended_itself(death.name)
        if not self._restarts.waits(death.name):
            pause = self._restarts.died(death.name, time.monotonic())
            self._say(f'{death.report()}\nstarting {death.name} anew in {pause:g} s')

    def _refuse_namesakes(self, names: Sequence[str]) -> None:
        if names:
            domain, namespace = os.environ.get(DOMAIN_ID) or '0', self.node.get_namespace()
            raise ChoiceError(
                f'{DOMAIN_ID} = {domain}: another {" and ".join(names)} runs there in namespace '
                f'{namespace}; stop it, or choose another domain or namespace'
            )

    def _last_error(self, name: str) -> str:
        return last_error(self._supervisor.last_lines(name, count=1000))


def command(
    description: NodeDescription,
    parameters: Path,
    keystore: Path | None = None,
    autostart: bool = False,
    paused: bool = False,
    member: str | None = None,
    namespace: str = ROOT,
    remappings: Sequence[tuple[str, str]] = (),
) -> Command:
    """Return the process of a node with its parameter file, in a namespace.

    If there is a keystore, its enclave is that of `member`, if it has none of its own.
    """
    arguments: tuple[str, ...] = (
        '--ros-args', '--params-file', str(parameters), '-r', f'__ns:={namespace}',
    )  # fmt: skip
    for name, other in remappings:
        arguments += ('-r', f'{name}:={other}')
    if autostart:
        arguments += ('-p', 'autostart:=true', '-p', f'paused:={str(paused).lower()}')
    enclave = security_arguments(member or description.name, keystore)
    return Command(
        description.name,
        (sys.executable, '-m', description.module, *arguments, *enclave),
        graph_environment(os.environ, keystore),
    )


def last_error(lines: tuple[str, ...]) -> str:
    """Return the text of the last error that a node has logged, empty if there is none."""
    matches = (_ERROR_LINE.match(line) for line in reversed(lines))
    return next((match[1] for match in matches if match), '')
