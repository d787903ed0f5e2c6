# SPDX-License-Identifier: Apache-2.0
"""What hinders the arm is named once it has lasted, and not before."""

import numpy as np
import pytest

from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.motion_watch import MotionWatch
from lwr_tracking.core.parameters import LimitParameters
from lwr_tracking.core.resolved_rate import Step

FREE = Step(np.zeros(7), 1.0, 1.0, False)
HINDRANCES = {
    Condition.JOINT_LIMIT: (FREE._replace(outward=0.05), False),
    Condition.SINGULAR: (FREE._replace(dexterity=0.05), False),
    Condition.SATURATED: (FREE._replace(saturated=True), False),
}


def judged(freedom, strained, ticks=5, running=True, watch=None):
    watch = watch or MotionWatch(LimitParameters(patience=0.02))
    return [watch.judge(0.004, freedom, strained, running) for _ in range(ticks)]


@pytest.mark.parametrize('condition', HINDRANCES)
def test_it_is_named_after_20_ms(condition):
    assert judged(*HINDRANCES[condition]) == [Condition.NONE] * 4 + [condition]


@pytest.mark.parametrize('condition', HINDRANCES)
def test_a_pause_begins_the_count_anew(condition):
    watch = MotionWatch(LimitParameters(patience=0.02))
    for _ in range(20):
        assert not any(judged(*HINDRANCES[condition], ticks=4, watch=watch))
        assert not any(judged(FREE, False, ticks=1, watch=watch))


def test_an_arm_that_strains_counts_as_saturated():
    assert judged(FREE, True) == [Condition.NONE] * 4 + [Condition.SATURATED]


def test_each_hindrance_is_counted_for_itself():
    watch = MotionWatch(LimitParameters(patience=0.02))
    for condition in 3 * [*HINDRANCES]:
        assert not any(judged(*HINDRANCES[condition], ticks=4, watch=watch))


def test_who_holds_still_is_not_hindered_by_limits():
    for condition in (Condition.JOINT_LIMIT, Condition.SINGULAR):
        assert not any(judged(*HINDRANCES[condition], ticks=100, running=False))


def test_slower_is_no_fault():
    assert not any(judged(FREE._replace(outward=0.2, dexterity=0.2), False, ticks=100))
