# SPDX-License-Identifier: Apache-2.0
"""The parameters of the tracker as a user writes them."""

import pytest

from lwr_tracking.core.parameters import GateParameters, LimitParameters, TrackerParameters
from srnn_config import ParameterError, UnknownKeyError, build, to_mapping


def test_they_survive_a_round_trip_through_plain_data():
    parameters = TrackerParameters(limits=LimitParameters(braking=1.0))
    assert build(TrackerParameters, to_mapping(parameters), 'file') == parameters


def test_an_unknown_key_names_the_valid_ones():
    with pytest.raises(UnknownKeyError, match='gate, contact, law, limits'):
        build(TrackerParameters, {'gates': {}}, 'file')


def test_a_margin_that_leaves_nothing_is_refused():
    with pytest.raises(ParameterError, match='margin'):
        GateParameters(half_width=0.05, margin=0.05)
