# SPDX-License-Identifier: Apache-2.0
"""What hinders the arm is named once it has lasted, and not before."""

import numpy as np
import pytest

from lwr_description import TORQUE_MAX
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.motion_watch import MotionWatch
from lwr_tracking.core.parameters import LimitParameters
from lwr_tracking.core.resolved_rate import Step
from srnn_msgs_py.joints import JointSample

ZERO = np.zeros(7)
FREE = Step(ZERO, 1.0, 1.0, False)
STRONG = JointSample(0, ZERO, ZERO, 0.999 * TORQUE_MAX, ZERO)
HINDRANCES = {
    Condition.JOINT_LIMIT: (FREE._replace(outward=0.05), STRONG),
    Condition.SINGULAR: (FREE._replace(dexterity=0.05), STRONG),
    Condition.SATURATED: (FREE._replace(saturated=True), STRONG),
}


def judged(freedom, sample, ticks=5, running=True, watch=None):
    watch = watch or MotionWatch(LimitParameters(patience=0.02), TORQUE_MAX)
    return [watch.judge(0.004, freedom, sample, running) for _ in range(ticks)]


@pytest.mark.parametrize('condition', HINDRANCES)
def test_it_is_named_after_20_ms(condition):
    assert judged(*HINDRANCES[condition]) == [Condition.NONE] * 4 + [condition]


@pytest.mark.parametrize('condition', HINDRANCES)
def test_a_pause_begins_the_count_anew(condition):
    watch = MotionWatch(LimitParameters(patience=0.02), TORQUE_MAX)
    for _ in range(20):
        assert not any(judged(*HINDRANCES[condition], ticks=4, watch=watch))
        assert not any(judged(FREE, STRONG, ticks=1, watch=watch))


@pytest.mark.parametrize('joint', range(7))
@pytest.mark.parametrize('sign', [-1.0, 1.0])
def test_torque_at_the_limit_of_any_joint_counts(joint, sign):
    torque = np.zeros(7)
    torque[joint] = sign * TORQUE_MAX[joint]
    sample = JointSample(0, ZERO, ZERO, torque, ZERO)
    assert judged(FREE, sample)[-1] is Condition.SATURATED


def test_who_holds_still_is_not_hindered_by_limits():
    for condition in (Condition.JOINT_LIMIT, Condition.SINGULAR):
        assert not any(judged(*HINDRANCES[condition], ticks=100, running=False))


def test_slower_is_no_fault():
    assert not any(judged(FREE._replace(outward=0.2, dexterity=0.2), STRONG, ticks=100))
