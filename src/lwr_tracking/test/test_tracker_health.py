# SPDX-License-Identifier: Apache-2.0
"""A tracker says what is wrong, and how bad that is."""

from perfect_arm import PROMPT, PerfectArm
import pytest
from segments import line

from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.silence_watch import SilenceWatch
from lwr_tracking.core.tracker_health import health_at_rest, health_at_work
from srnn_msgs_py.health import Health, HealthLevel


@pytest.fixture
def arm():
    arm = PerfectArm(PROMPT)
    arm.tick()
    return arm


@pytest.fixture
def watch(arm):
    watch = SilenceWatch()
    watch.heard(arm.sample(), 0.0)
    watch.heard(arm.sample(), 0.25)
    return watch


def test_at_rest_what_will_stop_it_is_an_error():
    assert health_at_rest(Condition.NONE) == Health()
    assert health_at_rest(Condition.STOPPED) == Health(HealthLevel.ERROR, 'stop asked for')


def test_at_work_it_tells_counters_forces_and_silence(arm, watch):
    arm.tracker.offer(line((0.0, 0.0), (9.0, 0.0), 0.1), 0.0)
    health = health_at_work(arm.tracker, watch)
    assert (health.level, health.message) == (HealthLevel.OK, '')
    assert health.values == {
        'accepted': 0, 'contacts': 0, 'yields': 0, 'faults': 0, 'soft_stops': 0,
        'late_ticks': 0, 'refused_outside': 1, 'force_n': arm.tracker.contact.force,
        'error_m': arm.tracker.contact.error, 'longest_silence_ms': 250.0,
    }  # fmt: skip


def test_what_passes_is_a_warning_and_what_lasts_an_error(arm, watch):
    arm.tracker.pause()
    health = health_at_work(arm.tracker, watch)
    assert (health.level, health.message) == (HealthLevel.WARN, 'paused')
    arm.tracker.stop()
    health = health_at_work(arm.tracker, watch)
    assert (health.level, health.message) == (HealthLevel.ERROR, 'stop asked for, paused')


def test_without_joint_states_nothing_else_matters(arm, watch):
    watch.begin()
    health = health_at_work(arm.tracker, watch)
    assert (health.level, health.message) == (HealthLevel.ERROR, 'no joint states')
    assert health.values['longest_silence_ms'] == 250.0
