# SPDX-License-Identifier: Apache-2.0
"""Definitions are those of ROS 2 Jazzy, whoever asks."""

import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from srnn_bag.definitions import definition
from srnn_bag.errors import UnknownTypeError
from srnn_msgs_py.topics import TOPICS

STORE = get_typestore(Stores.ROS2_JAZZY)
TYPES = sorted({row.type_name for row in TOPICS})


@pytest.mark.parametrize('type_name', TYPES)
def test_a_definition_says_what_the_jazzy_distribution_says(type_name):
    known = definition(type_name)
    assert known.digest == STORE.hash_rihs01(type_name)
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(known.text, type_name))
    assert store.hash_rihs01(type_name) == known.digest


@pytest.mark.parametrize('type_name', ['std_msgs/msg/Flaot64', 'nobody_msgs/msg/Thing', ''])
def test_an_unknown_type_is_named(type_name):
    with pytest.raises(UnknownTypeError, match=repr(type_name)):
        definition(type_name)
