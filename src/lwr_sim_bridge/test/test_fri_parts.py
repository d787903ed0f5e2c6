# SPDX-License-Identifier: Apache-2.0
"""The parts of the emulated controller: program, statistics, path, network."""

import numpy as np
import pytest

from lwr_sim_bridge.fri.answer_statistics import (
    BAD,
    OK,
    PERFECT,
    UNACCEPTABLE,
    AnswerStatistics,
)
from lwr_sim_bridge.fri.commanded_path import CommandedPath
from lwr_sim_bridge.fri.krl_program import JOINT_IMPEDANCE, PERIOD, POSITION, KrlProgram, Step
from lwr_sim_bridge.fri.link_faults import LinkFaults
from lwr_sim_bridge.fri.parameters import LinkFaultParameters, PatienceParameters


def wishes(**at):
    ints = [0] * 16
    for name, value in at.items():
        ints[int(name[1:])] = value
    return ints


class Program(KrlProgram):
    """Lets its period pass before each step."""

    now = 0.0

    def next(self, heard, perfect=True):
        self.now += PERIOD
        return self.step(self.now, heard, perfect)


def test_ros_control_starts_first_in_position_then_as_it_is_told():
    program = Program('ros_control')
    assert program.ints[1] == 10
    wish, rest = wishes(_0=JOINT_IMPEDANCE, _1=1), wishes(_0=JOINT_IMPEDANCE)
    assert program.next(wish, perfect=False) is Step.NOTHING
    assert program.next(wish) is Step.START
    assert (program.strategy, program.ints[1]) == (POSITION, 1)
    assert program.next(wish) is Step.NOTHING
    assert program.next(rest) is Step.STOP
    assert program.ints[1] == 0
    assert program.next(rest) is Step.NOTHING
    assert program.next(wish) is Step.START
    assert program.strategy == JOINT_IMPEDANCE


def test_fri_library_starts_as_it_is_told_and_counts_elsewhere():
    program = Program('fri_library')
    assert program.ints[15] == 10
    assert program.next(wishes(_14=JOINT_IMPEDANCE, _15=20)) is Step.NOTHING
    assert program.next(wishes(_14=JOINT_IMPEDANCE, _15=10)) is Step.START
    assert (program.strategy, program.ints[15]) == (JOINT_IMPEDANCE, 20)
    assert program.next(wishes(_14=JOINT_IMPEDANCE, _15=20)) is Step.STOP
    assert program.ints[15] == 10


def test_the_program_looks_only_now_and_then():
    program = KrlProgram('fri_library')
    idle, wish = wishes(_15=20), wishes(_14=POSITION, _15=10)
    program.step(0.0, idle, True)
    assert program.step(0.6 * PERIOD, wish, True) is Step.NOTHING
    assert program.step(1.01 * PERIOD, wish, True) is Step.START


def test_quality_is_an_account_of_answers_and_misses():
    statistics = AnswerStatistics(PatienceParameters(cap=20, perfect=16, ok=11))
    levels = [statistics.quality]
    for _ in range(20):
        statistics.answer(0.001)
        levels.append(statistics.quality)
    assert levels == [UNACCEPTABLE, *[BAD] * 10, *[OK] * 5, *[PERFECT] * 5]
    for _ in range(10):
        statistics.miss()
    assert (statistics.quality, statistics.misses, statistics.in_a_row) == (BAD, 10, 10)
    assert statistics.answer_rate == pytest.approx(20 / 30)
    statistics.answer(0.003)
    assert statistics.in_a_row == 0
    assert statistics.latency == pytest.approx((20 * 0.001 + 0.003) / 21)


def test_a_path_without_answers_goes_on_and_one_that_comes_late_knows_its_pace():
    path = CommandedPath(np.zeros(7))
    path.obey(np.full(7, 0.1))
    path.begin_cycle()
    path.bridge()
    assert np.allclose(path.target, 0.2)
    path.begin_cycle()
    path.bridge()
    path.begin_cycle()
    path.obey(np.full(7, 0.4))  # Three cycles after the last one that was obeyed.
    assert np.allclose(list(path.points(2)), [[0.35] * 7, [0.4] * 7])
    path.begin_cycle()
    path.bridge()
    assert np.allclose(path.target, 0.5)
    path.stand(path.target)
    path.begin_cycle()
    path.bridge()
    assert np.allclose(path.target, 0.5)
    assert not path.moves


def test_without_faults_everything_arrives_at_once_and_in_order():
    link = LinkFaults(LinkFaultParameters(), np.random.default_rng(1))
    for number in range(100):
        link.take(bytes([number]), 0.01 * number)
        assert link.arrived(0.01 * number) == [(bytes([number]), 0.01 * number)]
    assert link.next == np.inf


def test_losses_and_doubles_have_their_share_and_jitter_its_bound():
    # Shares of 10 000 packets: 5 standard deviations are 0.02, missed once in 2 million runs.
    faults = LinkFaultParameters(loss=0.2, duplicates=0.3, jitter=0.008)
    link = LinkFaults(faults, np.random.default_rng(1))
    for number in range(10_000):
        link.take(number.to_bytes(2, 'little'), 0.0)
    packets = link.arrived(1.0)
    numbers = [int.from_bytes(packet, 'little') for packet, _ in packets]
    times = np.array([time for _, time in packets])
    assert len(set(numbers)) / 10_000 == pytest.approx(0.8, abs=0.02)
    assert len(numbers) / len(set(numbers)) == pytest.approx(1.3, abs=0.03)
    assert (np.diff(times) >= 0.0).all()
    assert 0.0 <= times[0] < times[-1] <= 0.008
    assert numbers != sorted(numbers)


def test_levels_that_cannot_be_reached_are_refused():
    with pytest.raises(ValueError, match='perfect = 30: must be from ok = 11 to cap = 20'):
        PatienceParameters(perfect=30)
