# SPDX-License-Identifier: Apache-2.0
"""The strictest reaction wins, for every set of conditions."""

from itertools import combinations
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st
import pytest

from lwr_tracking.core.failsafe import RULES, Condition, Reaction, decide, markdown_table

ALL = list(Condition)


def test_every_condition_has_a_rule():
    assert set(RULES) == set(ALL)


def test_nothing_wrong_asks_for_nothing():
    decision = decide(Condition.NONE)
    assert decision.reaction is Reaction.NONE
    assert decision.latched is Condition.NONE
    assert decision.causes == ()


@pytest.mark.parametrize(('one', 'other'), list(combinations(ALL, 2)))
def test_the_strictest_wins_for_every_pair(one, other):
    decision = decide(one | other)
    assert decision.reaction is max(RULES[one].reaction, RULES[other].reaction)
    assert RULES[one].cause in decision.causes
    assert RULES[other].cause in decision.causes


@given(st.sets(st.sampled_from(ALL)))
def test_it_is_the_join_of_its_parts(conditions):
    together = Condition.NONE
    for condition in conditions:
        together |= condition
    decision = decide(together)
    assert decision.reaction == max((RULES[c].reaction for c in conditions), default=0)
    assert {c for c in ALL if c in decision.latched} == {c for c in conditions if RULES[c].latches}
    reactions = [next(r.reaction for r in RULES.values() if r.cause == cause)
                 for cause in decision.causes]
    assert reactions == sorted(reactions, reverse=True)


def test_only_freezing_latches():
    assert all(rule.reaction is Reaction.FREEZE for rule in RULES.values() if rule.latches)
    assert not RULES[Condition.CONTACT].latches


def test_every_rule_is_in_the_documentation():
    page = Path(__file__).parents[3] / 'docs' / 'faults.md'
    assert markdown_table() in page.read_text(encoding='utf-8')
