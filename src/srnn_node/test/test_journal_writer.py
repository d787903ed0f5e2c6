# SPDX-License-Identifier: Apache-2.0
"""Nothing that was noted is left out, doubled, or kept back for long."""

import time

from hypothesis import given
from hypothesis import strategies as st
import numpy as np

from srnn_msgs_py.journal import Deed, row
from srnn_node.journal import AGE_S, KEPT, MOST, JournalWriter


@given(st.lists(st.integers(0, 2**62), max_size=3 * MOST))
def test_the_parts_are_the_whole(stamps):
    parts = []
    writer = JournalWriter(parts.append, session=7)
    for stamp in stamps:
        writer.note(Deed.PLAN, stamp)
    writer.flush()
    writer.flush()
    assert [part.session for part in parts] == [7] * len(parts)
    assert [part.index for part in parts] == [MOST * n for n in range(len(parts))]
    rows = np.vstack([part.rows for part in parts]) if parts else np.zeros((0, 5))
    assert rows.tolist() == [list(row(Deed.PLAN, stamp)) for stamp in stamps]


def test_an_old_row_takes_the_next_one_along():
    parts = []
    writer = JournalWriter(parts.append, session=7)
    writer.note(Deed.CONFIGURED)
    assert not parts
    time.sleep(1.1 * AGE_S)
    writer.note(Deed.POSED, 11)
    (part,) = parts
    assert part.rows[:, :2].tolist() == [[Deed.CONFIGURED, 0], [Deed.POSED, 11]]


def test_what_cannot_be_published_waits_and_what_is_dropped_leaves_a_gap():
    parts, possible = [], []
    writer = JournalWriter(parts.append, session=7, is_open=lambda: bool(possible))
    for stamp in range(KEPT + MOST + 5):
        writer.note(Deed.PLAN, stamp)
    assert not parts
    possible.append(True)
    writer.flush()
    assert parts[0].index == parts[0].rows[0, 1] > 0
    stamps = np.concatenate([part.rows[:, 1] for part in parts])
    assert stamps.tolist() == list(range(parts[0].index, KEPT + MOST + 5))
    assert [part.index for part in parts] == [part.rows[0, 1] for part in parts]
