# SPDX-License-Identifier: Apache-2.0
"""The process that answers the controller, from the side of the node."""

import os
import signal
import socket
import time

import numpy as np
import pytest
from scripted_controller import HOME
from udp_controller import UdpController

from lwr_description import Kinematics, Mount
from lwr_fri_driver.core.parameters import DriverParameters, LinkParameters, SafetyParameters
from lwr_fri_driver.core.phase import Phase
from lwr_fri_driver.core.reports import Wish
from lwr_fri_driver.errors import LoopError
from lwr_fri_driver.loop_client import LoopClient
from lwr_fri_driver.loop_process import LoopParameters


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


def parameters(port):
    return LoopParameters(driver=DriverParameters(
        link=LinkParameters(port=port, controller='127.0.0.1', time_out=0.5),
        safety=SafetyParameters(steady=0.1, poor_cycles=1000),
    ))  # fmt: skip


@pytest.fixture
def client():
    made = LoopClient(parameters(free_port()))
    yield made
    made.close()


@pytest.fixture
def controller(client):
    with UdpController(client.port) as made:
        made.says = {'gravity': Kinematics(Mount()).gravity(np.array(HOME))}
        yield made


def wait_for(client, phase, seconds=20.0):
    until = time.monotonic() + seconds
    while client.status.phase is not phase:
        assert time.monotonic() < until, client.status
        client.wait(0.1)
        client.take()


def take_for_ever(client):
    while True:
        client.take()
        client.wait(5.0)


def test_from_silence_to_command_mode_and_back(client, controller):
    wait_for(client, Phase.MONITOR)
    client.wish(Wish.START)
    wait_for(client, Phase.COMMANDING)
    target, sample = np.array(HOME), None
    until = time.monotonic() + 1.0
    while time.monotonic() < until:
        target[3] += 0.0005
        client.command(target)
        client.wait(0.1)
        sample = client.take() or sample
    assert abs(sample.values[0, 3] - target[3]) < 0.01
    assert sample.values[1, 3] > 0.05
    assert abs(time.time_ns() - sample.stamp_ns) < 1e9
    client.wish(Wish.STOP)
    wait_for(client, Phase.MONITOR)
    rest = controller.answers[-1].position[3]
    assert abs(rest - target[3]) < 0.01


def test_the_node_hears_of_a_fault_and_of_its_end(client, controller):
    client.wish(Wish.START)
    wait_for(client, Phase.COMMANDING)
    controller.says = {'error': [3]}
    wait_for(client, Phase.FAULT)
    assert client.status.words == (
        'the arm is not fit: the controller reports an error of a drive'
    )
    controller.says = {'error': [0]}
    time.sleep(1.0)
    client.take()
    assert client.status.phase is Phase.FAULT
    client.wish(Wish.RESET)
    wait_for(client, Phase.COMMANDING)


def test_a_process_that_ends_is_noticed(client):
    os.kill(client.pid, signal.SIGKILL)
    with pytest.raises(LoopError, match='the process that answers the controller has ended'):
        take_for_ever(client)
    with pytest.raises(LoopError, match='has ended'):
        client.wish(Wish.STOP)


def test_signals_for_the_whole_group_are_left_to_the_node(client, controller):
    wait_for(client, Phase.MONITOR)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        os.kill(client.pid, number)
    client.wish(Wish.START)
    wait_for(client, Phase.COMMANDING)


def test_without_its_node_it_leaves_command_mode_before_it_ends(controller, client):
    client.wish(Wish.START)
    wait_for(client, Phase.COMMANDING)
    pid = client.pid
    client.close()
    assert controller.answers[-1].ints[1] == 0
    # It said so in more than the last packet.
    assert {answer.ints[1] for answer in controller.answers[-50:]} == {0}
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_a_port_that_is_taken_is_an_error_that_names_it():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(('', 0))
        port = other.getsockname()[1]
        with pytest.raises(LoopError, match=f'link.port = {port}: Address already in use'):
            LoopClient(parameters(port))
