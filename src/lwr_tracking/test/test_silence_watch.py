# SPDX-License-Identifier: Apache-2.0
"""How long there have been no joint states, by events and time."""

from hypothesis import given
from hypothesis import strategies as st
from perfect_arm import PerfectArm
import pytest

from lwr_tracking.core.silence_watch import SILENCE, SilenceWatch

SAMPLE = PerfectArm().sample()


def test_nothing_is_missed_before_the_first_joint_state():
    watch = SilenceWatch()
    assert watch.seconds_left(1e9) is None
    assert not watch.heard(SAMPLE, 1e9)
    assert watch.longest == 0.0


@given(st.lists(st.floats(0.0, 3.0 * SILENCE), min_size=1, max_size=20))
def test_a_joint_state_is_late_after_a_silence_and_only_then(pauses):
    watch, now = SilenceWatch(), 0.0
    watch.heard(SAMPLE, now)
    for pause in pauses:
        before, now = now, now + pause
        assert watch.seconds_left(now) == pytest.approx(SILENCE - pause, abs=1e-9)
        assert watch.heard(SAMPLE, now) == (now - before > SILENCE)
    assert watch.longest == pytest.approx(max(pauses), abs=1e-9)


def test_whoever_begins_anew_does_not_miss_what_was_before():
    watch = SilenceWatch()
    watch.heard(SAMPLE, 0.0)
    watch.begin()
    assert watch.sample is None
    assert watch.seconds_left(100.0) is None
    assert not watch.heard(SAMPLE, 100.0)
    assert watch.sample is SAMPLE
