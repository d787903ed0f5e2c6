# SPDX-License-Identifier: Apache-2.0
"""What the driver does with the ways of the KRL program on the controller."""

import numpy as np
import pytest
from scripted_controller import BITS, COMMANDING, HOME, MONITOR, POSITION, ScriptedController

from lwr_fri_driver.core.parameters import ControlParameters, DriverParameters, LinkParameters
from lwr_fri_driver.core.phase import Fault, Phase


@pytest.fixture
def krc():
    return ScriptedController()


def test_a_program_that_first_starts_in_joint_position_is_stopped_and_asked_again(krc):
    krc.say(control=POSITION)
    krc.connection.request(True)
    krc.cycles(1.1)
    answer = krc.cycle(state=COMMANDING)
    assert krc.connection.phase is Phase.LEAVING
    assert answer.ints[1] == 0
    assert np.allclose(answer.position, HOME, atol=BITS)
    krc.cycle(state=MONITOR)
    krc.cycles(0.6)
    krc.cycle(state=COMMANDING, control=3)
    assert krc.connection.commanding


def test_a_program_that_never_starts_the_law_that_was_set_is_given_up(krc):
    krc.say(control=POSITION)
    krc.connection.request(True)
    for _ in range(2):
        krc.cycles(1.1)
        krc.cycle(state=COMMANDING)
        krc.cycle(state=MONITOR)
    assert krc.connection.fault is Fault.OTHER_CONTROL


def test_a_program_that_does_not_answer_is_given_up(krc):
    krc.connection.request(True)
    krc.cycles(12.0)
    assert krc.connection.fault is Fault.NO_START
    krc.connection.reset(krc.now)
    krc.cycles(1.0)
    krc.cycle(state=COMMANDING)
    assert krc.connection.commanding
    krc.connection.request(False)
    krc.cycles(10.5)
    assert krc.connection.fault is Fault.NO_STOP


def test_a_driver_that_finds_command_mode_it_has_not_asked_for_holds_and_ends_it(krc):
    krc.connection.request(True)
    answer = krc.cycles(2.0, state=COMMANDING)
    assert answer.ints[1] == 0
    assert np.allclose(answer.position, HOME, atol=BITS)
    assert not krc.connection.commanding


def test_the_other_handshake_and_the_other_law():
    krc = ScriptedController(DriverParameters(
        link=LinkParameters(handshake='fri_library'),
        control=ControlParameters(strategy='joint_position'),
    ))  # fmt: skip
    krc.say(control=POSITION)
    answer = krc.cycles(0.1)
    assert (answer['motion.flags'], answer.ints[14], answer.ints[15]) == (1, 10, 20)
    krc.connection.request(True)
    assert krc.cycles(1.1).ints[15] == 10
    krc.cycle(state=COMMANDING)
    assert krc.connection.commanding
