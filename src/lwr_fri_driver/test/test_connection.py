# SPDX-License-Identifier: Apache-2.0
"""The conversation with the controller, packet by packet."""

import copy

from golden import MEASUREMENT, put
from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest
from scripted_controller import (
    BITS,
    COMMANDING,
    CYCLE,
    HOME,
    MONITOR,
    POSITION,
    ScriptedController,
)

from lwr_description import VELOCITY_MAX
from lwr_fri_driver.core.phase import Fault, Phase

MIRRORED = ScriptedController()
MIRRORED.cycle()
COMMANDED = ScriptedController()
COMMANDED.to_command_mode()


@pytest.fixture
def krc():
    return ScriptedController()


def move(krc, joint, velocity, seconds):
    """Command a joint at a constant velocity, in step with the packets; return all answers."""
    answers = []
    target = krc.cycle().position.astype(float)
    for _ in range(round(seconds / CYCLE)):
        target[joint] += velocity * CYCLE
        assert krc.connection.command(target, krc.now) is None
        answers.append(krc.cycle())
        krc.obey(answers[-1])
    return answers


def test_the_commanded_and_not_the_measured_pose_is_mirrored_until_command_mode(krc):
    offset = np.full(7, 0.125)
    sagging = np.array(HOME) + 0.3
    for _ in range(300):
        answer = krc.cycle(joint_offset=offset, joint_position=sagging)
        assert np.allclose(answer.position, HOME + offset, rtol=0, atol=BITS)
        assert not answer['motion.joint_torque'].any()
        assert not answer['motion.tool_wrench'].any()
        assert answer['motion.flags'] == 0x0035
        assert answer.ints[1] == 0


def test_counters_and_reflections_go_on_and_wrap(krc):
    krc.sequence = 65530
    for n in range(20):
        answer = krc.cycle()
        assert answer['head.sequence'] == n
        assert answer['head.reflected'] == krc.sequence % 65536


def test_command_mode_is_asked_for_on_request_alone_and_only_after_a_steady_while(krc):
    assert krc.cycles(5.0).ints[1] == 0
    krc.connection.request(True)
    assert krc.connection.phase is Phase.MONITOR
    krc.cycle(quality=2)
    assert krc.cycles(2.0).ints[1] == 0
    krc.cycle(quality=3)
    assert krc.cycles(0.49).ints[1] == 0
    assert krc.connection.phase is Phase.READYING
    answer = krc.cycles(0.02)
    assert answer.ints[1] == 1
    assert answer.ints[0] == 30
    assert krc.connection.phase is Phase.STARTING
    krc.cycle(state=COMMANDING)
    assert krc.connection.commanding


def test_command_mode_begins_where_the_controller_stands(krc):
    krc.say(joint_offset=np.full(7, 0.125), joint_position=np.array(HOME) + 0.3)
    answer = krc.to_command_mode()
    assert np.allclose(answer.position, np.array(HOME) + 0.125, rtol=0, atol=BITS)
    assert (answer['motion.joint_stiffness'] == 1000.0).all()
    assert np.allclose(answer['motion.joint_damping'], 0.7)


@pytest.mark.parametrize(('says', 'words'), [
    ({'power': 0x3F}, 'drives are off'),
    ({'error': 4}, 'the controller reports an error of a drive'),
    ({'warning': 1}, 'the controller reports a warning'),
    ({'joint_position': [np.nan, *HOME[1:]]}, 'a measurement is no finite number'),
    ({'external_torque': [0.0] * 6 + [np.inf]}, 'a measurement is no finite number'),
    ({'joint_position': [2.96, *HOME[1:]]}, 'a joint is at its limit'),
    ({'measurement_period': 0.01}, 'the controller sends at another rate than was set'),
    ({'control': POSITION}, 'the controller moves the arm by another law than was set'),
])  # fmt: skip
def test_whatever_makes_the_arm_unfit_ends_command_mode_until_reset(krc, says, words):
    krc.to_command_mode()
    move(krc, 3, -0.3, 0.5)
    before = krc.cycle().position
    answer = krc.cycle(**says)
    assert (krc.connection.phase, krc.connection.fault) == (Phase.FAULT, Fault.UNFIT)
    assert krc.connection.cause == f'the arm is not fit: {words}'
    assert answer.ints[1] == 0
    assert np.abs(answer.position - before).max() < 0.01
    krc.cycle(state=MONITOR)
    assert krc.cycles(3.0).ints[1] == 0
    assert krc.connection.phase is Phase.FAULT


@pytest.mark.parametrize('says', [
    {'power': 0}, {'error': 1}, {'warning': 1}, {'quality': 1}, {'measurement_period': 0.004},
    {'joint_position': [*HOME[:6], -2.96]}, {'gravity': [0, 4.5, 0, 0, 0, 0, 0]},
])  # fmt: skip
def test_an_unfit_arm_is_not_even_asked_for(krc, says):
    krc.connection.request(True)
    assert krc.cycles(3.0, **says).ints[1] == 0
    assert krc.connection.phase is Phase.READYING
    assert krc.connection.unfit


def test_a_few_packets_of_poor_quality_are_borne(krc):
    krc.to_command_mode()
    krc.cycles(5 * CYCLE, quality=1)
    assert krc.connection.commanding
    krc.cycle(quality=2)
    krc.cycles(5 * CYCLE, quality=0)
    assert krc.connection.commanding
    krc.cycle()
    assert krc.connection.cause == (
        'the arm is not fit: the controller finds the link too poor'
    )


def test_commands_are_followed_with_the_lag_of_the_filter_and_no_step_is_too_long(krc):
    krc.to_command_mode()
    answers = move(krc, 3, 0.4, 1.0)
    path = np.array([answer.position[3] for answer in answers])
    lag = 2 * 0.004 - 0.5 * CYCLE  # The filter knows a command half a cycle ahead on average.
    assert path[-1] == pytest.approx(HOME[3] + 0.4 * (1.0 - lag), abs=1e-4)
    assert np.diff(path).max() <= 0.4 * CYCLE * 1.01
    assert (np.diff(path) >= -BITS).all()


def test_a_limit_on_the_step_holds_back_and_lets_catch_up(krc):
    krc.say(safety_limits=0.2)
    krc.to_command_mode()
    answers = move(krc, 0, 0.9 * VELOCITY_MAX[0], 0.2)
    steps = np.diff([answer.position[0] for answer in answers])
    assert steps.max() <= 0.95 * 0.2 * VELOCITY_MAX[0] * CYCLE + BITS
    assert krc.connection.clamped > 20
    target = 0.9 * VELOCITY_MAX[0] * 0.2
    for _ in range(400):
        krc.connection.command([target, *HOME[1:]], krc.now)
        answer = krc.cycle()
    assert answer.position[0] == pytest.approx(target, abs=1e-4)


def test_when_commands_cease_the_arm_comes_to_rest_at_the_last_one_then_command_mode_ends(krc):
    krc.to_command_mode()
    last = move(krc, 3, 0.4, 0.5)[-1].position
    answer = krc.cycles(0.9)
    assert krc.connection.commanding
    assert answer.position[3] == pytest.approx(last[3] + 0.4 * 0.008, abs=1e-3)
    krc.cycles(0.2)
    assert krc.connection.fault is Fault.NO_COMMANDS


def test_before_the_first_command_the_arm_just_holds(krc):
    answer = krc.to_command_mode()
    assert (krc.cycles(5.0).position == answer.position).all()
    assert krc.connection.commanding


def test_leaving_command_mode_brings_the_arm_to_rest_without_return_before_it_asks(krc):
    krc.to_command_mode()
    move(krc, 3, 0.5, 0.5)
    krc.connection.request(False)
    path = []
    answer = krc.cycle()
    while answer.ints[1] == 1:
        path.append(answer.position[3])
        answer = krc.cycle()
    assert krc.connection.phase is Phase.LEAVING
    assert (np.diff(path) >= -BITS).all()
    assert len(path) * CYCLE < 0.1
    assert abs(krc.cycle().position[3] - path[-1]) < 1e-4
    krc.cycle(state=MONITOR)
    assert krc.connection.phase is Phase.MONITOR
    assert krc.cycles(3.0).ints[1] == 0


def test_a_controller_that_leaves_by_itself_needs_a_reset_and_the_whole_way_anew(krc):
    krc.to_command_mode()
    krc.cycle(state=MONITOR)
    assert krc.connection.fault is Fault.FELL_BACK
    assert krc.cycles(3.0).ints[1] == 0
    krc.connection.reset(krc.now)
    krc.cycle()
    krc.cycle()
    assert krc.connection.phase is Phase.READYING
    assert krc.cycles(0.6).ints[1] == 1
    krc.cycle(state=COMMANDING)
    assert krc.connection.commanding


def test_a_silent_controller_is_noticed_and_its_return_alone_moves_nothing(krc):
    krc.to_command_mode()
    krc.connection.silence(krc.now + 0.09)
    assert krc.connection.commanding
    krc.connection.silence(krc.now + 0.11)
    assert krc.connection.fault is Fault.SILENT
    krc.now += 1.0
    assert krc.cycle().ints[1] == 0
    krc.cycle(state=MONITOR)
    assert krc.cycles(3.0).ints[1] == 0


def test_silence_in_monitor_mode_is_no_fault(krc):
    krc.connection.request(True)
    krc.cycles(0.2)
    krc.connection.silence(krc.now + 0.2)
    assert krc.connection.phase is Phase.SILENT
    krc.cycles(1.2)
    assert krc.connection.phase is Phase.STARTING


def test_a_controller_that_counts_anew_ends_command_mode(krc):
    krc.sequence = 1000
    krc.to_command_mode()
    krc.sequence = 0
    answers = [krc.cycle() for _ in range(6)]
    assert answers[:4] == [None] * 4
    assert krc.connection.fault is Fault.RESTARTED


def test_doubles_and_latecomers_are_not_answered(krc):
    krc.cycles(0.1)
    late = krc.sequence
    krc.sequence += 1
    krc.cycle()
    newest = krc.sequence
    for sequence in (newest, late + 1, late):
        krc.sequence = sequence
        assert krc.connection.answer(krc.datagram(), krc.now) is None
    krc.sequence = newest
    assert krc.cycle() is not None


@settings(max_examples=300, deadline=None)
@given(
    st.sampled_from(sorted(name for name in MEASUREMENT if not name.startswith('head.'))),
    st.binary(min_size=4, max_size=4), st.booleans(),
)  # fmt: skip
def test_whatever_a_field_says_no_answer_is_no_number_or_a_leap(name, raw, commanding):
    krc = copy.deepcopy(COMMANDED if commanding else MIRRORED)
    data = bytearray(krc.datagram())
    put(data, MEASUREMENT, 'head.sequence', krc.sequence + 1)
    offset, code, _ = MEASUREMENT[name]
    size = 2 if code == 'H' else 4
    data[offset : offset + size] = raw[:size]
    answer = krc.connection.answer(bytes(data), krc.now + CYCLE)
    if answer is None:
        return
    position = np.frombuffer(answer[144:172], '<f4')
    assert np.isfinite(position).all()
    if commanding:
        assert np.abs(position - HOME).max() <= BITS
