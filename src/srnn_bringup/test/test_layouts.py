# SPDX-License-Identifier: Apache-2.0
"""The layouts for RViz and Foxglove show topics that there are, as they travel."""

import json
from pathlib import Path
import re

import pytest
import yaml

from srnn_bringup.bag_recorder import LOG
from srnn_msgs_py.segment import FRAME
from srnn_msgs_py.topics import TOPICS

CONFIG = Path(__file__).parents[3] / 'config'
KNOWN = {f'/{row.name.lstrip("/")}': row for row in (*TOPICS, LOG)}
SHOWN = {row.name for row in TOPICS if 'display' in row.meaning} | {'belief_markers'}
TYPES = {
    'Map': 'nav_msgs/msg/OccupancyGrid',
    'MarkerArray': 'visualization_msgs/msg/MarkerArray',
    'Path': 'nav_msgs/msg/Path',
    'Pose': 'geometry_msgs/msg/PoseStamped',
}


def displays():
    layout = yaml.safe_load((CONFIG / 'srnn.rviz').read_text())['Visualization Manager']
    assert layout['Global Options']['Fixed Frame'] == FRAME
    return [one for one in layout['Displays'] if 'Topic' in one]


@pytest.mark.parametrize('display', displays(), ids=lambda one: one['Name'])
def test_rviz_hears_what_is_sent(display):
    told = display['Topic']
    row = KNOWN[f'/{told["Value"]}']
    assert TYPES[display['Class'].rpartition('/')[2]] == row.type_name
    assert (told['Durability Policy'] == 'Transient Local') == row.qos.latched
    assert told['Depth'] == row.qos.depth


def test_rviz_shows_all_that_is_for_display():
    assert {one['Topic']['Value'] for one in displays()} == SHOWN | {'current_pose'}


def test_foxglove_shows_topics_and_panels_that_there_are():
    layout = json.loads((CONFIG / 'foxglove_layout.json').read_text())
    text = json.dumps(layout)
    named = set(re.findall(r'"(/[a-z_/]+)', text))
    assert named <= KNOWN.keys()
    assert {f'/{name}' for name in SHOWN} <= named
    assert set(re.findall(r'"((?:\w+)!\w+)"', json.dumps(layout['layout']))) == set(
        layout['configById']
    )
