# SPDX-License-Identifier: Apache-2.0
"""Only commands that the arm could follow come through; the others are counted by reason."""

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from lwr_description import POSITION_MAX, VELOCITY_MAX, ArmDescription
from lwr_guard import CommandGate, GuardParameters, Refusal

PARAMETERS = GuardParameters()
START = np.zeros(7)
LIMITS = ArmDescription().limits


@pytest.fixture
def gate():
    return CommandGate(PARAMETERS, LIMITS, START)


@pytest.mark.parametrize(
    ('command', 'refusal'),
    [
        ([0.0] * 6, Refusal.MALFORMED),
        ([[0.0] * 7], Refusal.MALFORMED),
        (['a'] * 7, Refusal.MALFORMED),
        ([10**400] * 7, Refusal.MALFORMED),
        ([np.nan] + [0.0] * 6, Refusal.NOT_FINITE),
        ([0.0] * 6 + [np.inf], Refusal.NOT_FINITE),
        ([0.0, 2.2] + [0.0] * 5, Refusal.OUT_OF_RANGE),
        ([0.0, 0.5] + [0.0] * 5, Refusal.TOO_FAR),
    ],
)
def test_bad_commands_are_refused_counted_and_forgotten(gate, command, refusal):
    assert gate.offer(command, 1.0) is refusal
    assert gate.refused[refusal] == 1
    assert sum(gate.refused.values()) == 1
    np.testing.assert_array_equal(gate.last, START)


def test_steps_up_to_the_speed_limit_are_accepted(gate):
    q, now = START, 1.0
    for _ in range(20):
        q, now = q + 0.999 * PARAMETERS.period * VELOCITY_MAX, now + PARAMETERS.period
        assert gate.offer(q, now) is None
    assert gate.offer(q + 1.01 * PARAMETERS.period * VELOCITY_MAX, now) is Refusal.TOO_FAR


@pytest.mark.parametrize('now', [0.0, 100.0])
def test_a_stream_begins_within_one_period_of_where_the_arm_started(gate, now):
    """What is farther is told to another arm, and would make this one jump."""
    assert gate.offer(1.01 * PARAMETERS.period * VELOCITY_MAX, now) is Refusal.TOO_FAR
    assert gate.offer(0.99 * PARAMETERS.period * VELOCITY_MAX, now) is None


def test_long_silence_buys_no_longer_step_than_the_stated_one(gate):
    assert gate.offer(START, 1.0) is None
    assert gate.offer(1.01 * PARAMETERS.silence * VELOCITY_MAX, 100.0) is Refusal.TOO_FAR
    assert gate.offer(0.99 * PARAMETERS.silence * VELOCITY_MAX, 100.0) is None


shares, pauses = st.floats(-0.25, 1.0), st.sampled_from([0.0, 0.0, 0.0, 0.004])


@given(st.lists(st.tuples(st.just(0.19) | shares, pauses), min_size=20, max_size=60))
def test_many_commands_at_once_do_not_add_up_to_more_speed(steps):
    gate, now, accepted = CommandGate(PARAMETERS, LIMITS, START), 1.0, [(1.0, START)]
    for share, elapsed in steps:
        now += elapsed
        command = gate.last + share * PARAMETERS.silence * VELOCITY_MAX
        if gate.offer(command, now) is None:
            accepted.append((now, command))
    times = np.array([time for time, _ in accepted])
    angles = np.array([command for _, command in accepted])
    passed = np.abs(times[:, None] - times) + PARAMETERS.silence
    turned = np.abs(angles[:, None] - angles)
    assert (turned <= passed[..., None] * VELOCITY_MAX + 1e-12).all()


def test_a_flood_is_bounded_and_a_stream_after_it_is_followed(gate):
    assert gate.offer(START, 1.0) is None
    step = 0.99 * PARAMETERS.period * VELOCITY_MAX
    verdicts = [gate.offer(gate.last + step, 1.001) for _ in range(50)]
    assert verdicts.count(None) == round(PARAMETERS.silence / PARAMETERS.period)
    assert gate.offer(gate.last + step, 1.001 + PARAMETERS.period) is None


def test_silence_shorter_than_the_period_is_refused():
    with pytest.raises(ValueError, match='silence'):
        GuardParameters(period=0.01, silence=0.005)


anything = st.lists(st.one_of(st.none(), st.text(max_size=3), st.floats()), max_size=8)
plausible = st.lists(st.floats(-0.1, 0.1), min_size=7, max_size=7)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.one_of(anything, plausible), max_size=5))
def test_nothing_that_comes_in_gets_an_impossible_command_through(commands):
    gate = CommandGate(PARAMETERS, LIMITS, START)
    for k, command in enumerate(commands):
        before = gate.last.copy()
        gate.offer(command, 1.0 + 0.004 * k)
        assert np.isfinite(gate.last).all()
        assert (np.abs(gate.last) <= POSITION_MAX).all()
        assert (np.abs(gate.last - before) <= PARAMETERS.silence * VELOCITY_MAX).all()


def test_limits_that_are_not_even_about_zero_are_those_of_each_side():
    limits = LIMITS._replace(
        position_min=np.array([0.1, -1.0]), position_max=np.array([2.0, -0.2]),
        velocity_max=np.ones(2),
    )  # fmt: skip
    start = np.array([0.1, -0.2])
    for command, refusal in (
        ([0.1, -0.2], None), ([0.099, -0.2], Refusal.OUT_OF_RANGE),
        ([0.1, -0.199], Refusal.OUT_OF_RANGE), ([0.101, -0.201], None),
        ([0.1] * 7, Refusal.MALFORMED),
    ):  # fmt: skip
        assert CommandGate(PARAMETERS, limits, start).offer(command, 1.0) is refusal
