# SPDX-License-Identifier: Apache-2.0
from types import SimpleNamespace

import numpy as np
import pytest

from srnn_bringup.standstill import SPAN_S, Standstill
from srnn_msgs_py.tip import TipPosition

PERIOD_S = 0.02


def told(speed: float, seconds: float) -> Standstill:
    """Return what has heard of a tip that moves in the plane."""
    node = SimpleNamespace(create_subscription=lambda *_: None)
    value = Standstill(node)
    for time in np.arange(0.0, seconds, PERIOD_S):
        value.take(TipPosition(0, np.array([speed * time, 0.0, 0.0])), float(time))
    return value


def test_a_tip_that_holds_its_place_for_a_while_stands_still():
    assert told(0.0, SPAN_S + 0.1)()


@pytest.mark.parametrize(('speed', 'seconds'), [(0.005, 3.0), (0.0, SPAN_S - 0.1), (0.0, 0.0)])
def test_a_slow_tip_and_one_not_heard_of_do_not(speed, seconds):
    assert not told(speed, seconds)()


def test_motion_of_long_ago_does_not_count():
    value = told(0.1, 1.0)
    assert not value()
    for time in np.arange(1.0, 1.1 + SPAN_S, PERIOD_S):
        value.take(TipPosition(0, np.array([0.1, 0.0, 0.0])), float(time))
    assert value()
