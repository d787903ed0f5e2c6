# SPDX-License-Identifier: Apache-2.0
"""`srnn record`: a running graph, whoever has started it."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
import sys
from typing import Any

import yaml

from srnn_bag import Attachment
from srnn_bringup import bag_attachments
from srnn_bringup.bag_recorder import BagRecorder, record
from srnn_bringup.console import Console
from srnn_bringup.errors import Interrupted
from srnn_bringup.graph import NAMES
from srnn_bringup.neighbours import neighbours
from srnn_bringup.parameter_client import ParameterClient
from srnn_bringup.peer_profile import talking_to
from srnn_bringup.peers import Peer
from srnn_bringup.session import session
from srnn_node.signals import StopRequest

COMMAND = 'srnn_record'

RECORDING = 'recording to'
"""What it says once it listens."""


def run_record(
    directory: Path,
    peers: Sequence[Peer],
    keystore: Path | None,
    namespace: str,
    remappings: Sequence[tuple[str, str]],
) -> int:
    """Record a graph of this domain until the user stops it; return the exit code.

    Args:
        directory: new directory to record to.
        peers: other hosts, where a part of the graph runs.
        keystore: keystore that protects the graph, None for none.
        namespace: absolute ROS namespace of the graph.
        remappings: names of topics, and what the nodes of the graph use instead.

    """
    console = Console(sys.stdout)

    def guard() -> None:
        if stop.name is not None:
            raise Interrupted(stop.name)

    with (
        talking_to(peers),
        StopRequest() as stop,
        session(COMMAND, guard, keystore, namespace) as (node, pump),
    ):
        with record(node, directory, remappings) as recorder:
            recorder.attach([bag_attachments.summary(joined=True)])
            console.note(f'{RECORDING} {directory}; Ctrl-C ends the recording')
            clients: dict[str, ParameterClient] = {}
            try:
                while True:
                    pump.turn()
                    for name in set(neighbours(node)) & set(NAMES) - clients.keys():
                        clients[name] = ParameterClient(node, name)
                    _attach(recorder, clients.values())
            except Interrupted:
                pass
        console.note(recorder.words())
    return 0


def _attach(recorder: BagRecorder, clients: Iterable[ParameterClient]) -> None:
    for client in clients:
        values = client.poll()
        if values is not None:
            recorder.attach(_files(client.name, values))


def _files(name: str, values: Mapping[str, Any]) -> list[Attachment]:
    """Return what a node was told, and the files that it names if they are on this host."""
    content = {'/**': {'ros__parameters': dict(values)}}
    files = [bag_attachments.of_node(name, yaml.safe_dump(content, sort_keys=False).encode())]
    for key, attach in (
        ('scene', bag_attachments.of_scene), ('initial_weights', bag_attachments.of_weights),
    ):  # fmt: skip
        path = Path(str(values.get(key) or ''))
        if name in ('planner', 'adapter') and path.is_file():
            files.append(attach(path))
    return files
