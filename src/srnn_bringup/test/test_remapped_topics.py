# SPDX-License-Identifier: Apache-2.0
"""What a graph hears under another name is in its bag, and found there."""

import numpy as np
import pytest

from srnn_bag import open_bag
from srnn_bringup.bag_recorder import record
from srnn_bringup.session import session
from srnn_msgs_py.ros import weights
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate
from srnn_replay.recording import Recording, remapped_topics

WAIT_S = 20.0
SHARED = WeightsUpdate(
    3, 0, LearnedWeights(225, 0, np.array([7]), np.array([0.5], dtype=np.float32))
)


@pytest.fixture(params=['weights:=/left/weights', '/right/weights:=/left/weights', ''])
def bag(request, tmp_path):
    """Return a bag of namespace /right, recorded while the graph in /left shares weights."""
    rules = [tuple(request.param.split(':='))] if request.param else []
    row = topic('weights')
    with session('other_graph', lambda: None, namespace='/right') as (node, pump):
        sender = node.create_publisher(
            message_type(row.type_name), '/left/weights', profile(row.qos)
        )
        with record(node, tmp_path / 'bag', rules) as recorder:
            sender.publish(weights.to_msg(SHARED))
            if rules:
                assert pump.until(lambda: recorder.writer.contents.count, WAIT_S)
    return open_bag(tmp_path / 'bag'), bool(rules)


def test_a_remapped_topic_is_recorded_by_its_name_and_read_by_its_place(bag):
    found, remapped = bag
    assert ('/left/weights' in found.topics) == remapped
    assert ('/right/weights' in found.topics) != remapped
    assert remapped_topics(found) == ({'/right/weights': '/left/weights'} if remapped else {})
    heard = Recording(found, 'planner', ('weights', 'segment'), '/right/')
    told = [one.value.version for one in heard.decoded('weights', weights.from_msg)]
    assert told == ([3] if remapped else [])
    assert heard.raw('segment') == []
