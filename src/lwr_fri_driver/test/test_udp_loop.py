# SPDX-License-Identifier: Apache-2.0
"""The loop on real sockets, turn by turn."""

import socket
import time

import numpy as np
import pytest
from scripted_controller import COMMANDING, HOME, MONITOR, Answer, ScriptedController

from lwr_fri_driver.core.parameters import DriverParameters, LinkParameters, SafetyParameters
from lwr_fri_driver.core.phase import Phase
from lwr_fri_driver.core.reports import Sample, Status, Wish, pack_command, unpack_report
from lwr_fri_driver.udp_loop import FAREWELL, UdpLoop


class Rig:
    """A controller and a node at the two sockets of a loop."""

    def __init__(self, parameters):
        self.controller = self.socket()
        self.udp = self.socket()
        self.node, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.node.settimeout(0.0)
        self.krc = ScriptedController(parameters)
        self.connection = self.krc.connection
        self.loop = UdpLoop(self.udp, theirs, self.connection, parameters, 'as it is')
        self._theirs = theirs

    def socket(self):
        made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        made.bind(('127.0.0.1', 0))
        made.settimeout(0.0)
        return made

    def send(self, data, sender=None):
        (sender or self.controller).sendto(data, self.udp.getsockname())

    def measure(self, **says):
        self.krc.say(**says)
        self.krc.sequence += 1
        self.send(self.krc.datagram())

    def answers(self, receiver=None):
        found = []
        while True:
            try:
                found.append(Answer((receiver or self.controller).recv(4096)))
            except BlockingIOError:
                return found

    def exchange(self, **says):
        self.measure(**says)
        self.loop.turn()
        (answer,) = self.answers()
        return answer

    def reports(self, kind):
        found = []
        while True:
            try:
                found.append(unpack_report(self.node.recv(1 << 16)))
            except BlockingIOError:
                return [report for report in found if isinstance(report, kind)]

    def to_command_mode(self):
        self.node.send(Wish.START.value)
        until = time.monotonic() + 20.0
        while self.connection.phase is not Phase.STARTING and time.monotonic() < until:
            self.exchange()
            time.sleep(0.001)
        self.exchange(state=COMMANDING)
        assert self.connection.commanding

    def close(self):
        for each in (self.controller, self.udp, self.node, self._theirs):
            each.close()


@pytest.fixture
def rig():
    made = Rig(DriverParameters(
        link=LinkParameters(cycle=0.005, time_out=0.5), safety=SafetyParameters(steady=0.1)
    ))  # fmt: skip
    yield made
    made.close()


def test_every_packet_is_answered_to_where_it_came_from(rig):
    for _ in range(50):
        answer = rig.exchange()
        assert answer['head.reflected'] == rig.krc.sequence
        assert np.allclose(answer.position, HOME)


def test_others_are_neither_answered_nor_heard(rig):
    rig.exchange()
    stranger = rig.socket()
    with stranger:
        rig.krc.sequence += 1
        rig.send(rig.krc.datagram(), stranger)
        rig.loop.turn()
        assert not rig.answers(stranger)
    assert rig.connection.sequence.last == rig.krc.sequence - 1
    rig.krc.sequence -= 1
    rig.exchange()
    time.sleep(0.6)
    rig.loop.turn()
    assert rig.reports(Status)[-1].values['foreign'] == 1


def test_a_host_that_was_named_is_the_only_one(rig):
    named = Rig(DriverParameters(link=LinkParameters(controller='127.0.0.2')))
    try:
        named.measure()
        named.loop.turn()
        assert not named.answers()
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as right:
            right.bind(('127.0.0.2', 0))
            right.settimeout(0.0)
            named.send(named.krc.datagram(), right)
            named.loop.turn()
            assert len(named.answers(right)) == 1
    finally:
        named.close()


@pytest.mark.parametrize('data', [b'', b'x', bytes(376), bytes(915), bytes(917), bytes(9000)])
def test_garbage_is_counted_and_nobody_is_believed_for_it(rig, data):
    with rig.socket() as stranger:
        rig.send(data, stranger)
        rig.loop.turn()
        assert not rig.answers(stranger)
    assert rig.connection.malformed == 1
    rig.exchange()


def test_of_packets_that_waited_the_newest_is_answered(rig):
    for _ in range(7):
        rig.measure()
    rig.loop.turn()
    (answer,) = rig.answers()
    assert answer['head.reflected'] == rig.krc.sequence
    assert rig.connection.link.share == pytest.approx(1.0 / 7.0)


def test_a_controller_that_was_silent_may_come_back_from_another_port(rig):
    rig.exchange()
    rig.controller.close()
    rig.controller = rig.socket()
    rig.measure()
    rig.loop.turn()
    assert not rig.answers()
    time.sleep(0.6)
    rig.loop.turn()
    assert rig.connection.phase is Phase.SILENT
    rig.exchange()
    assert rig.connection.phase is Phase.MONITOR


def test_measurements_go_to_the_node_while_commands_move_the_arm_and_only_then(rig):
    rig.exchange()
    assert not rig.reports(Sample)
    rig.to_command_mode()
    rig.reports(Sample)
    before = time.time_ns()
    rig.exchange(joint_torque=np.arange(7.0), external_torque=-np.arange(7.0))
    (sample,) = rig.reports(Sample)
    assert before <= sample.stamp_ns <= time.time_ns()
    position, velocity, torque, external = sample.values
    assert np.allclose(position, HOME)
    assert not velocity.any()
    assert (torque == np.arange(7.0)).all()
    assert (external == -np.arange(7.0)).all()


def test_commands_of_the_node_move_the_answer_once_it_may(rig):
    target = np.array(HOME)
    rig.node.send(pack_command(target + 0.001))
    assert np.allclose(rig.exchange().position, HOME)
    rig.to_command_mode()
    assert np.allclose(rig.exchange().position, HOME)
    rig.node.send(pack_command(target + 0.001))
    for _ in range(30):
        answer = rig.exchange()
    assert np.allclose(answer.position, target + 0.001, atol=1e-6)


def test_phases_are_reported_when_they_change(rig):
    rig.loop.turn()
    assert rig.reports(Status)[-1].phase is Phase.SILENT
    rig.exchange()
    status = rig.reports(Status)[-1]
    assert (status.phase, status.words) == (Phase.MONITOR, 'monitor mode')
    assert status.values['scheduling'] == 'as it is'
    assert status.values['quality'] == 'PERFECT'
    rig.to_command_mode()
    rig.exchange(state=MONITOR)
    status = rig.reports(Status)[-1]
    assert status.phase is Phase.FAULT
    assert status.words == 'the controller has left command mode by itself'


def test_without_the_node_command_mode_is_left_and_the_arm_still_mirrored_for_a_while(rig):
    rig.to_command_mode()
    rig.node.close()
    answer = rig.exchange()
    while answer.ints[1] == 1:
        answer = rig.exchange()
    assert rig.connection.phase is Phase.LEAVING
    assert not rig.loop.finished
    rig.exchange(state=MONITOR)
    for n in range(FAREWELL - 1):
        assert not rig.loop.finished, n
        rig.exchange()
    assert rig.loop.finished


def test_without_node_and_controller_there_is_nothing_to_do(rig):
    rig.node.close()
    rig.loop.turn()
    assert rig.loop.finished


def test_a_status_says_what_keeps_the_arm_from_command_mode(rig):
    rig.exchange()
    rig.node.send(Wish.START.value)
    for _ in range(4):
        rig.exchange(power=0)
    time.sleep(0.6)
    rig.exchange(power=0)
    assert rig.reports(Status)[-1].words == (
        'waiting until the controller is fit: drives are off'
    )
