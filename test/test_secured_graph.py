# SPDX-License-Identifier: Apache-2.0
"""The graph with DDS security: it works, strangers see nothing, members stay within their rights.

Runs where the middleware has DDS security; that of the wheels has none.
"""

from collections.abc import Iterator, Sequence
import os
from pathlib import Path
import shutil
import subprocess
import sys

from cryptography.hazmat.primitives.serialization import load_pem_private_key
from cryptography.x509 import load_pem_x509_certificate
import pytest

from srnn_bringup.config import Choices, load
from srnn_bringup.dds_security.certificates import Identity, sign
from srnn_bringup.dds_security.enforcement import lack_of_security
from srnn_bringup.dds_security.keystore import SIGNED, create_keystore, enclave_folder
from srnn_bringup.environment import (
    domain_id,
    graph_environment,
    security_arguments,
    security_variables,
)
from srnn_bringup.live_graph import LiveGraph
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import NODES, TOPICS, topic
from srnn_node.signals import StopRequest

PATIENCE_S = 30.0
LOOK_S = 8.0
"""How long a guest looks for the graph [s]; a member finds it at once."""

GUEST = """
from contextlib import suppress
import sys, time
import rclpy
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import TOPICS

NODES = {'sim_bridge', 'tracker', 'adapter', 'planner'}
RCLError = rclpy_implementation.RCLError
name, seconds, *arguments = sys.argv[1:]
try:
    rclpy.init(args=arguments)
    node = Node(name, enable_rosout=False, start_parameter_services=False)
except RCLError:
    print('fails to enter')
    sys.exit()
heard = []
for row in TOPICS:
    kind, qos = message_type(row.type_name), profile(row.qos)
    with suppress(RCLError):
        node.create_publisher(kind, row.name, qos)
        print('writes', row.name)
    with suppress(RCLError):
        node.create_subscription(kind, row.name, lambda _, name=row.name: heard.append(name), qos)
        print('reads', row.name)

def complete():
    return '/diagnostics' in heard and NODES <= set(node.get_node_names())

end = time.monotonic() + float(seconds)
while time.monotonic() < end and not complete():
    rclpy.spin_once(node, timeout_sec=0.1)
print('hears', *sorted(set(heard)))
for name in node.get_node_names():
    print('sees', name)
"""


class Guest:
    """What a process found in the domain, by its own account."""

    def __init__(
        self, name: str, environment: dict[str, str], arguments: Sequence[str] = (),
        seconds: float = LOOK_S,
    ) -> None:
        command = [sys.executable, '-c', GUEST, name, str(seconds), *arguments]
        done = subprocess.run(
            command, env=environment, capture_output=True, text=True, timeout=4 * PATIENCE_S
        )
        assert done.returncode == 0, done.stderr
        self._lines = [line.partition(' ') for line in done.stdout.splitlines()]

    def said(self, verb: str) -> set[str]:
        return {name for word, _, rest in self._lines if word == verb for name in rest.split()}


@pytest.fixture(scope='module')
def keystore(tmp_path_factory: pytest.TempPathFactory) -> Path:
    lack = lack_of_security(os.environ)
    if lack:
        pytest.skip(f'this middleware has no DDS security: {lack}')
    return made(tmp_path_factory.mktemp('ours') / 'keystore')


@pytest.fixture(scope='module')
def graph(keystore: Path) -> Iterator[LiveGraph]:
    configuration = load(Choices(keystore=keystore, seed=1))
    with StopRequest() as stop, LiveGraph(configuration, stop, print) as graph:
        graph.configure()
        graph.activate()
        yield graph


def made(directory: Path) -> Path:
    create_keystore(directory, domain_id(os.environ))
    return directory


def member(name: str, keystore: Path, seconds: float = LOOK_S) -> Guest:
    environment = graph_environment(os.environ, keystore)
    return Guest(name, environment, security_arguments(name, keystore), seconds)


def rows(role: str, node: str) -> set[str]:
    return {row.name for row in TOPICS if node in getattr(row, role)}


def test_segments_are_planned_and_executed(graph):
    ended = []
    row = topic('segment_result')
    graph.node.create_subscription(
        message_type(row.type_name), row.name, ended.append, profile(row.qos)
    )
    assert graph.pump.until(lambda: len(ended) >= 2, PATIENCE_S)


def test_the_command_sees_and_hears_the_graph(graph, keystore):
    guest = member('srnn', keystore)
    assert guest.said('sees') >= set(graph.names)
    assert '/diagnostics' in guest.said('hears')
    assert guest.said('writes') == {'waypoints'}


@pytest.mark.parametrize('node', NODES)
def test_a_node_writes_and_reads_its_rows_of_the_table_and_no_others(graph, keystore, node):
    guest = member(node, keystore, seconds=0.0)
    assert guest.said('writes') == rows('publishers', node)
    assert guest.said('reads') == rows('subscribers', node)


def test_who_has_no_key_sees_and_hears_nothing(graph):
    environment = graph_environment(os.environ)
    for name in security_variables(Path()):
        environment.pop(name, None)
    guest = Guest('stranger', environment)
    assert not guest.said('sees') & set(graph.names)
    assert not guest.said('hears')


def test_who_has_the_key_of_another_authority_sees_and_hears_nothing(graph, tmp_path):
    guest = member('srnn', made(tmp_path / 'theirs'))
    assert not guest.said('sees') & set(graph.names)
    assert not guest.said('hears')


def test_a_node_cannot_give_itself_rights(graph, keystore, tmp_path):
    taken = Path(shutil.copytree(keystore, tmp_path / 'taken', symlinks=True))
    shutil.rmtree(taken / 'private')
    folder = enclave_folder(taken, 'planner')
    key = load_pem_private_key((folder / 'key.pem').read_bytes(), None)
    identity = Identity(load_pem_x509_certificate((folder / 'cert.pem').read_bytes()), key)
    wish = (folder / 'permissions.xml').read_text()
    wish = wish.replace('rt/segment<', 'rt/forward_position_controller/commands<')
    (folder / SIGNED).write_bytes(sign(identity, wish))
    guest = member('planner', taken, seconds=0.0)
    assert guest.said('fails') == {'to', 'enter'}
    assert not guest.said('writes')
