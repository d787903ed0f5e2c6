# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from lwr_description import Kinematics, Mount
from lwr_fri_driver.core.parameters import ControlParameters, DriverParameters, SafetyParameters
from lwr_fri_driver.core.rehearsal import rehearse


@pytest.mark.parametrize('cycle', [0.001, 0.005, 0.02])
@pytest.mark.parametrize('strategy', ['joint_position', 'joint_impedance'])
def test_a_rehearsal_goes_to_command_mode_and_back(cycle, strategy):
    parameters = DriverParameters(
        control=ControlParameters(strategy=strategy), safety=SafetyParameters(steady=60.0),
    )  # fmt: skip
    parameters = replace(parameters, link=replace(parameters.link, cycle=cycle))
    assert rehearse(parameters, Kinematics(Mount()).gravity)
