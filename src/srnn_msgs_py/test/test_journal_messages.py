# SPDX-License-Identifier: Apache-2.0
"""A journal travels bit for bit, times included."""

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.journal import WIDTH, Deed, Journal, bits, number, row
from srnn_msgs_py.ros import journal

wholes = st.integers(-(2**63), 2**63 - 1)
times = st.floats(allow_nan=False)
rows = st.lists(st.builds(row, st.sampled_from(Deed), wholes, wholes, times, times), max_size=9)


@given(st.integers(0, 2**62), st.integers(0, 2**40), rows)
def test_it_arrives_as_it_was_sent(session, index, written):
    table = np.array(written, dtype=np.int64).reshape(-1, WIDTH)
    read = journal.from_msg(journal.to_msg(Journal(session, index, table)))
    assert (read.session, read.index) == (session, index)
    np.testing.assert_array_equal(read.rows, table)


@given(st.floats(allow_nan=False))
def test_a_time_keeps_its_bits(value):
    assert number(bits(value)) == value
    assert np.signbit(number(bits(value))) == np.signbit(value)


def test_another_layout_is_refused():
    msg = journal.to_msg(Journal(1, 0, np.zeros((2, WIDTH), np.int64)))
    msg.layout.dim[1].size = WIDTH + 5
    msg.layout.dim[0].size = 1
    with pytest.raises(MessageError, match='columns: must be 5'):
        journal.from_msg(msg)
