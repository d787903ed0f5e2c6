# SPDX-License-Identifier: Apache-2.0
"""Every deed is noted before it is done, so that whoever reads the notes can do it again."""

from dataclasses import replace

import numpy as np
from perfect_arm import PERIOD, PROMPT, PerfectArm
import pytest
from segments import line

from lwr_description import Kinematics, Mount
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.tracking_session import TrackingSession
from srnn_msgs_py.journal import Deed

SAMPLE = PerfectArm().sample()


class Notes:
    """A journal that also knows what the tracker was like when a deed was noted."""

    def __init__(self):
        self.session = None
        self.rows = []

    def __call__(self, deed, *numbers, **named):
        conditions = self.session.tracker.conditions if self.session else None
        self.rows.append((deed, numbers, named, conditions))

    @property
    def deeds(self):
        return [row[0] for row in self.rows]


@pytest.fixture(scope='module')
def kinematics():
    return Kinematics(Mount())


@pytest.fixture
def notes():
    return Notes()


@pytest.fixture
def session(kinematics, notes):
    notes.session = TrackingSession(PROMPT, kinematics, notes)
    notes.session.begin(Condition.NONE)
    notes.rows.clear()
    return notes.session


@pytest.mark.parametrize('latched', [Condition.NONE, Condition.STOPPED | Condition.SILENT])
def test_an_activation_has_a_tracker_of_its_own_that_stops_where_the_last_was_stopped(
    session, notes, latched
):
    before = session.tracker
    session.begin(latched)
    assert session.tracker is not before
    assert session.tracker.conditions == latched | Condition.NOT_STARTED
    assert [row[:2] for row in notes.rows] == [(Deed.ACTIVATED, (latched.value,))]


@pytest.mark.parametrize(('deed', 'condition'), [
    (Deed.STOP, Condition.STOPPED),
    (Deed.SILENT, Condition.SILENT),
    (Deed.PAUSE, Condition.PAUSED),
])  # fmt: skip
def test_what_stops_is_noted_first(session, notes, deed, condition):
    session.tick(1.0, SAMPLE)
    {Deed.STOP: session.stop, Deed.SILENT: session.silence, Deed.PAUSE: session.pause}[deed]()
    assert condition in session.tracker.conditions
    assert notes.rows[-1][0] is deed
    assert condition not in notes.rows[-1][3]


@pytest.mark.parametrize(('deed', 'condition'), [
    (Deed.RESET, Condition.STOPPED),
    (Deed.RESUME, Condition.PAUSED),
])  # fmt: skip
def test_what_goes_on_is_noted_first(session, notes, deed, condition):
    session.tick(1.0, SAMPLE)
    session.stop()
    session.pause()
    {Deed.RESET: session.reset, Deed.RESUME: session.resume}[deed]()
    assert condition not in session.tracker.conditions
    assert notes.rows[-1][0] is deed
    assert condition in notes.rows[-1][3]


def test_measurements_and_segments_are_noted_by_their_stamps(session, notes):
    session.tick(1.0, replace(SAMPLE, stamp_ns=40, lag_ns=-3))
    session.tick(1.1, replace(SAMPLE, stamp_ns=44), Deed.ASSUMED)
    assert session.offer(line((0.0, 0.0), (0.1, 0.0), 0.1, stamp_ns=50), 0.25) is None
    assert [row[:3] for row in notes.rows] == [
        (Deed.MEASURED, (40, -3, 1.0), {}),
        (Deed.ASSUMED, (44, 0, 1.1), {}),
        (Deed.OFFERED, (50,), {'time_s': 0.25}),
    ]


def test_after_a_silence_nothing_goes_out_until_reset(session):
    assert session.tick(1.0, SAMPLE).command is not None
    session.silence()
    assert session.tick(1.1, SAMPLE).command is None
    session.reset()
    np.testing.assert_array_equal(session.tick(1.2, SAMPLE).command, SAMPLE.position)


def test_an_arm_that_is_assumed_to_follow_comes_to_rest_on_the_path(session):
    sample, now = SAMPLE, 1.0
    session.tick(now, sample)
    assert session.at_rest
    assert session.offer(line((0.0, 0.0), (0.2, 0.0), 0.1), 0.0) is None

    def goes_on(sample, now):
        sample = session.assumed(sample, sample.stamp_ns + 4_000_000)
        session.tick(now, sample, Deed.ASSUMED)
        return sample, now + PERIOD

    for _ in range(150):
        sample, now = goes_on(sample, now)
    assert not session.at_rest
    session.pause()
    for _ in range(150):
        sample, now = goes_on(sample, now)
    assert session.at_rest
    assert session.tracker.reference.running is not None
    assert not session.tracker.latched


def test_nothing_that_has_not_begun_has_to_come_to_rest(session):
    assert session.tracker.reference is None
    assert session.at_rest
