# SPDX-License-Identifier: Apache-2.0
"""Samples and spikes come back, those first that became the segment."""

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
import numpy as np
import pytest

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.imagination import Imagination
from srnn_msgs_py.ros import samples, spikes

SHAPE = (4, 3, 2)
numbers = hnp.arrays(np.float32, SHAPE, elements=st.floats(-1.0, 1.0, width=32))


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(numbers, hnp.arrays(np.bool_, 4), hnp.arrays(np.uint8, (3, 5)))
def test_they_come_back(wire, paths, kept, fired):
    value = Imagination(7, paths, kept, fired)
    back, count = samples.from_msg(wire(samples.to_msg(value)))
    assert count == kept.sum()
    np.testing.assert_array_equal(back[:count], paths[kept])
    np.testing.assert_array_equal(back[count:], paths[~kept])
    np.testing.assert_array_equal(spikes.from_msg(wire(spikes.to_msg(value))), fired)


def test_more_kept_than_there_are_is_refused():
    value = Imagination(7, np.zeros(SHAPE, np.float32), np.ones(4, bool), np.zeros((3, 5)))
    msg = samples.to_msg(value)
    msg.layout.dim[-1].label = 'kept=5'
    with pytest.raises(MessageError, match='kept = 5: must be <= 4'):
        samples.from_msg(msg)
