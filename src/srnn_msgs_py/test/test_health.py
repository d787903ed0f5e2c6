# SPDX-License-Identifier: Apache-2.0
from srnn_msgs_py.health import Health, in_namespace

HERE, THERE, DEEPER = Health(message='here'), Health(message='there'), Health(message='deeper')
HEALTHS = {'/planner': HERE, '/left/planner': THERE, '/left/arm/planner': DEEPER}


def test_graphs_that_share_a_topic_are_told_apart_by_their_namespaces():
    assert in_namespace(HEALTHS, '/') == {'/planner': HERE}
    assert in_namespace(HEALTHS, '/left') == {'/left/planner': THERE}
    assert in_namespace(HEALTHS, '/left/arm') == {'/left/arm/planner': DEEPER}
    assert in_namespace(HEALTHS, '/right') == {}
