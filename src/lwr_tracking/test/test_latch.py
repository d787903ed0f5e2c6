# SPDX-License-Identifier: Apache-2.0
"""What stops the arm is told once and left to a successor, whatever becomes of the file."""

from hypothesis import given
from hypothesis import strategies as st
import pytest

from lwr_tracking.core.failsafe import Condition, decide
from lwr_tracking.latch import Latch

sets = st.sets(st.sampled_from(list(Condition)), max_size=4).map(
    lambda conditions: Condition(sum(condition.value for condition in conditions))
)


@given(story=st.lists(sets, max_size=8))
def test_a_successor_begins_where_its_predecessor_was(tmp_path_factory, story):
    path = str(tmp_path_factory.mktemp('latch') / 'latch')
    first = Latch(path, lambda text: None)
    for conditions in story:
        first.follow(conditions)
        assert first.conditions == decide(conditions).latched
    assert Latch(path, lambda text: None).conditions == first.conditions


@given(story=st.lists(sets, max_size=8))
def test_only_what_is_new_is_told(story):
    said, before = [], Condition.NONE
    latch = Latch('', said.append)
    for conditions in story:
        count = len(said)
        latch.follow(conditions)
        latch.follow(conditions)
        assert len(said) - count == bool(latch.conditions & ~before)
        before = latch.conditions


def test_all_that_stops_the_arm_is_named():
    said = []
    latch = Latch('', said.append)
    latch.follow(Condition.STOPPED | Condition.PAUSED)
    latch.follow(Condition.STOPPED | Condition.SILENT)
    assert said == [
        'frozen until reset: stop asked for',
        'frozen until reset: stop asked for, no joint states',
    ]


def test_a_stop_that_was_asked_for_is_kept_and_not_told(tmp_path):
    said = []
    latch = Latch(str(tmp_path / 'latch'), said.append)
    latch.add(Condition.STOPPED)
    assert said == []
    assert Latch(str(tmp_path / 'latch'), said.append).conditions == Condition.STOPPED


@pytest.mark.parametrize('name', ['missing/latch', '.'])
def test_a_file_that_cannot_be_written_is_told_of_and_the_arm_stays_stopped(tmp_path, name):
    said = []
    latch = Latch(str(tmp_path / name), said.append)
    latch.follow(Condition.STOPPED | Condition.JUMPED)
    assert said[0].startswith('frozen until reset: ')
    assert said[1].startswith('latch: ')
    assert latch.conditions == Condition.STOPPED | Condition.JUMPED
