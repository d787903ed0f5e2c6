# SPDX-License-Identifier: Apache-2.0
"""Driver and emulated controller without faults: every joint, law, cycle and program."""

from fri_world import FriWorld
import numpy as np
import pytest

from lwr_fri_driver.core.parameters import ControlParameters, DriverParameters
from lwr_fri_driver.core.phase import Phase
from lwr_sim_bridge.fri.controller import JOINT_IMPEDANCE_CONTROL, POSITION_CONTROL
from lwr_sim_bridge.fri.parameters import ControllerParameters


@pytest.mark.parametrize('handshake', ['ros_control', 'fri_library'])
@pytest.mark.parametrize(('strategy', 'control'), [
    ('joint_position', POSITION_CONTROL), ('joint_impedance', JOINT_IMPEDANCE_CONTROL),
])  # fmt: skip
def test_from_silence_to_command_mode_and_back_by_both_programs_and_laws(
    handshake, strategy, control
):
    parameters = DriverParameters(control=ControlParameters(strategy=strategy))
    world = FriWorld(parameters=parameters, handshake=handshake)
    world.to_command_mode()
    assert world.controller.control == control
    world.swing(1.0)
    world.connection.request(False)
    world.run(0.5)
    again = [Phase.STARTING, Phase.LEAVING, Phase.MONITOR, Phase.READYING]
    twice = handshake == 'ros_control' and strategy == 'joint_impedance'
    assert world.phases == [
        Phase.SILENT, Phase.MONITOR, Phase.READYING, *(again if twice else []),
        Phase.STARTING, Phase.COMMANDING, Phase.LEAVING, Phase.MONITOR,
    ]  # fmt: skip
    assert world.controller.message == ''
    assert world.longest_step() <= 1.0


@pytest.mark.parametrize('cycle', [2, 4, 10])
def test_other_cycles_move_the_arm_as_far(cycle):
    world = FriWorld(cycle=cycle)
    world.to_command_mode()
    before = world.joints[-1]
    world.swing(1.0, joint=1)  # Half a swing: it ends at the far side.
    world.run(0.3)
    expected = np.where(np.arange(7) == 1, 0.1, 0.0)
    assert np.allclose(world.joints[-1] - before, expected, atol=4e-3)
    assert world.longest_step() <= 1.0
    assert world.connection.commanding


@pytest.mark.parametrize('joint', range(7))
def test_each_joint_alone_moves_as_commanded_and_is_measured_so(joint):
    world = FriWorld()
    world.to_command_mode()
    before = world.joints[-1]
    world.swing(1.0, joint=joint)
    world.run(0.2)
    moved = world.joints[-1] - before
    assert moved[joint] == pytest.approx(0.1, abs=2e-3)
    assert np.abs(np.delete(moved, joint)).max() < 2e-3
    data = world.connection.measurement.data
    assert np.allclose(data.joint_position, world.joints[-1], atol=1e-3)


def test_stiffness_of_the_configuration_reaches_the_arm():
    sag = []
    for stiffness in (1000.0, 250.0):
        control = ControlParameters(stiffness=(stiffness,) * 7)
        world = FriWorld(parameters=DriverParameters(control=control))
        world.to_command_mode()
        world.controller.arm.data.qfrc_applied[1] = 10.0
        world.run(1.5)
        loaded = world.joints[-1][1]
        world.controller.arm.data.qfrc_applied[1] = 0.0
        world.run(1.5)
        sag.append(loaded - world.joints[-1][1])
    # Dry friction of .2 Nm helps to hold on both ways.
    assert sag == pytest.approx([0.01, 0.04], rel=0.1)


def test_half_speed_at_the_controller_is_kept_by_the_driver():
    world = FriWorld(emulator=ControllerParameters(velocity_share=0.1))
    world.to_command_mode()
    world.swing(2.0, amplitude=0.4, frequency=1.0)
    assert world.connection.commanding, world.connection.cause
    assert world.connection.clamped > 0
    assert world.longest_step() * world.parameters.control.velocity_share <= 0.1


def test_load_data_of_another_tool_keep_the_driver_out_of_command_mode():
    world = FriWorld()
    world.controller.tamper = lambda reading: reading._replace(gravity=1.3 * reading.gravity)
    world.connection.request(True)
    world.run(3.0)
    assert world.phase is Phase.READYING
    assert 'OTHER_LOAD' in world.connection.unfit.name
