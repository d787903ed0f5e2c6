# SPDX-License-Identifier: Apache-2.0
"""When the arm counts as touching something."""

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from lwr_tracking.core.contact_observer import ContactObserver, Touch
from lwr_tracking.core.parameters import ContactParameters
from srnn_config import ParameterError

LIMITS = ContactParameters()


def touches(observer, forces, error=0.0):
    return [observer.update(force, 0.0, 0.0, error) for force in forces]


@given(st.lists(st.floats(0.0, 30.0), min_size=1, max_size=50))
def test_force_touches_exactly_when_two_samples_in_a_row_agree(forces):
    told = touches(ContactObserver(LIMITS), forces)
    high = [force > LIMITS.force for force in forces]
    for i, touch in enumerate(told):
        expected = i > 0 and high[i] and high[i - 1]
        assert touch is (Touch.FORCE if expected else Touch.NONE)


def test_error_touches_after_two_samples_also_when_not_armed():
    observer = ContactObserver(LIMITS)
    observer.disarm()
    assert touches(observer, [0.0, 0.0], error=0.006) == [Touch.NONE, Touch.ERROR]


def test_the_direction_in_the_plane_does_not_matter():
    for angle in np.linspace(0.0, 6.0, 9):
        observer = ContactObserver(LIMITS)
        fx, fy = 10.1 * np.cos(angle), 10.1 * np.sin(angle)
        assert [observer.update(fx, fy, 0.0, 0.0) for _ in range(2)][1] is Touch.FORCE


def test_what_is_left_of_a_contact_is_not_the_next_one():
    observer = ContactObserver(LIMITS)
    assert touches(observer, [20.0, 20.0])[1] is Touch.FORCE
    observer.disarm()
    assert set(touches(observer, [20.0, 15.0, 4.0, 11.0, 12.0, 6.0])) == {Touch.NONE}
    assert observer.loaded
    assert set(touches(observer, [4.0, 4.0])) == {Touch.NONE}
    assert not observer.loaded
    assert touches(observer, [20.0, 20.0]) == [Touch.NONE, Touch.FORCE]


def test_a_hysteresis_upside_down_is_refused():
    with pytest.raises(ParameterError, match='rearm_force'):
        ContactParameters(force=5.0, rearm_force=6.0)
