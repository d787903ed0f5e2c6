# SPDX-License-Identifier: Apache-2.0
"""The live view of a graph, as a process beside it."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
import tempfile
import time

from srnn_bringup.config import SIMULATED, Configuration
from srnn_bringup.dds_security.enclaves import COMMAND
from srnn_bringup.errors import NotReadyError
from srnn_bringup.graph import write_parameters
from srnn_bringup.live_graph import command
from srnn_bringup.node_description import NodeDescription
from srnn_bringup.supervisor import Supervisor
from srnn_config import to_mapping

VIEW = 'view'
START_S = 30.0
"""Longest wait for the page [s]."""

READY = 'live view:'
"""What the view says once there is something to be seen."""


@contextmanager
def viewing(
    configuration: Configuration, port: int | None, say: Callable[[str], None]
) -> Iterator[Mapping[str, int]]:
    """Serve the page of a graph meanwhile; yield the process of the view by its name.

    Args:
        configuration: what the nodes are told.
        port: TCP port of the page, 0 for any; None for no page.
        say: told where the page is, and if it has ended.

    Raises:
        NotReadyError: there is no page; the message says why.

    """
    if port is None:
        yield {}
        return
    view = describe(configuration, port)
    with tempfile.TemporaryDirectory(prefix='srnn_view_') as folder:
        files = write_parameters([view], Path(folder))
        with Supervisor(Path(folder)) as supervisor:
            process = command(
                view, files[VIEW], configuration.keystore, member=COMMAND,
                namespace=configuration.namespace,
            )  # fmt: skip
            supervisor.start(process)
            say(_await(supervisor))
            try:
                yield supervisor.pids
            finally:
                for death in supervisor.deaths():
                    say(death.report())


def describe(configuration: Configuration, port: int) -> NodeDescription:
    """Return the view of a graph."""
    return NodeDescription(
        VIEW, 'srnn_view', 'view', 'srnn_view.view_node',
        {
            'scene': str(configuration.scene_path),
            'obstacles': configuration.robot == SIMULATED or configuration.emulated,
            'port': port,
            'mount': to_mapping(configuration.arm.mount),
        },
    )  # fmt: skip


def _await(supervisor: Supervisor) -> str:
    """Return where the page is."""
    end = time.monotonic() + START_S
    while time.monotonic() < end:
        lines = supervisor.last_lines(VIEW)
        for line in lines:
            if line.startswith(READY):
                return line
        if not supervisor.alive(VIEW):
            raise NotReadyError(lines[-1] if lines else f'{VIEW} has ended without a word')
        time.sleep(0.05)
    raise NotReadyError(f'{VIEW}: no page within {START_S:g} s')
