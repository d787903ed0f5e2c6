# SPDX-License-Identifier: Apache-2.0
"""A node that was started anew is heard from its first word on by whoever was there before."""

from pathlib import Path

from watched_graph import Watched

from srnn_bag import open_bag
from srnn_bringup.config import Choices, load
from srnn_bringup.live_graph import LiveGraph
from srnn_bringup.restarts import Restarts
from srnn_node.signals import StopRequest

ROUNDS = 3

SPOKEN = {
    'mock_arm': ('/joint_states', '/external_torque/joint_states'),
    'tracker': ('/forward_position_controller/commands', '/tracker/journal'),
}
"""Topics on which each of them says something at once."""


def firsts(bag: Path, topic: str) -> list[int]:
    """Return the number of the first message that was heard of each sender."""
    found, previous = [], 0
    for message in sorted(open_bag(bag).messages({topic}), key=lambda m: m.sent_ns):
        if message.sequence <= previous or not found:
            found.append(message.sequence)
        previous = message.sequence
    return found


def test_a_recorder_misses_no_word_of_any_successor(tmp_path):
    said: list[str] = []
    bag = tmp_path / 'bag'
    configuration = load(Choices(arm='mock'))
    with (
        StopRequest() as stop,
        LiveGraph(configuration, stop, said.append, Restarts(), tuple(SPOKEN), bag) as graph,
    ):
        watched = Watched(graph, guarded=True)
        graph.configure()
        graph.activate()
        for node, heard in (('tracker', watched.commands), ('mock_arm', watched.joints)):
            for _ in range(ROUNDS):
                killed, before = graph.pids[node], len(heard)
                watched.until(lambda h=heard, n=before: len(h) > n + 20)
                watched.kill(node)
                watched.until(lambda n=node, p=killed: graph.pids[n] != p)
            before = len(heard)
            watched.until(lambda h=heard, n=before: len(h) > n + 20)
    assert [words for words in said if 'LOST' in words] == []
    for topics in SPOKEN.values():
        for topic in topics:
            assert firsts(bag, topic) == [1] * (1 + ROUNDS), topic
