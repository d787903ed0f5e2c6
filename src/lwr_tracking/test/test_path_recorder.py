# SPDX-License-Identifier: Apache-2.0
"""What counts as executed."""

import numpy as np
from segments import line

from lwr_tracking.core.path_recorder import PathRecorder

START = 40.0
SEGMENT = line((0.0, 0.0), (0.1, 0.05), 0.1)


def record(until):
    recorder = PathRecorder(SEGMENT, START)
    for clock in np.arange(START - 0.01, START + until, 0.0037):
        recorder.add(clock, 2.0 * (clock - START), -(clock - START))
    return recorder


def test_the_tip_is_told_at_the_times_of_the_plan():
    recorder = record(SEGMENT.duration + 0.004)
    assert recorder.complete
    assert recorder.progress == 1.0
    executed = recorder.executed()
    assert executed.stamp_ns == SEGMENT.stamp_ns
    np.testing.assert_array_equal(executed.times, SEGMENT.times)
    expected = np.outer(SEGMENT.times, (2.0, -1.0))
    np.testing.assert_allclose(executed.positions, expected, atol=1e-12)


def test_after_a_contact_the_last_tip_is_held():
    recorder = record(0.5 * SEGMENT.duration)
    assert not recorder.complete
    assert 0.45 < recorder.progress <= 0.5
    positions = recorder.executed().positions
    held = positions[SEGMENT.times > 0.5 * SEGMENT.duration]
    assert len(held) > 10
    np.testing.assert_array_equal(held, np.broadcast_to(held[0], held.shape))


def test_waiting_on_the_path_does_not_stretch_the_record():
    recorder = record(0.5 * SEGMENT.duration)
    middle = START + 0.5 * SEGMENT.duration
    for wobble in range(1000):
        recorder.add(middle, SEGMENT.duration + 1e-6 * wobble, -0.5 * SEGMENT.duration)
    recorder.add(START + SEGMENT.duration, 2.0 * SEGMENT.duration, -SEGMENT.duration)
    assert recorder.complete
    expected = np.outer(SEGMENT.times, (2.0, -1.0))
    np.testing.assert_allclose(recorder.executed().positions, expected, atol=1.1e-3)
