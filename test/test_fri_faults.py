# SPDX-License-Identifier: Apache-2.0
"""Driver against emulated controller, with all that a network and a controller can do wrong.

Whatever happens: no step is longer than permitted, the driver is in a state with a name,
and only an explicit command brings it back, which moves nothing by itself.
"""

from fri_world import FriWorld
import numpy as np
import pytest

from lwr_fri_driver.core.phase import Fault, Phase
from lwr_sim_bridge.fri.controller import MONITOR
from lwr_sim_bridge.fri.parameters import LinkFaultParameters

slow = pytest.mark.slow

STILL = 2e-4
"""More than noise and sag move a joint in a cycle [rad]."""

SAG = 2e-3
"""Way of a joint when another law takes over, or brakes hold what was in motion [rad]."""


@pytest.fixture
def world():
    made = FriWorld()
    made.to_command_mode()
    made.swing(0.5)
    return made


def check(world):
    """Check what always holds."""
    assert world.longest_step() <= 1.0
    assert world.phase in Phase
    assert (world.connection.fault is not Fault.NONE) == (world.phase is Phase.FAULT)
    assert bool(world.connection.cause) == (world.phase is Phase.FAULT)


def recover(world):
    """Check that nothing but an explicit command helps, and that it moves nothing."""
    world.set_faults(LinkFaultParameters())
    world.controller.tamper = lambda reading: reading
    world.silent = False
    world.run(0.5)
    world.controller.acknowledge()
    world.run(1.0)
    assert world.phase is Phase.FAULT
    resting = world.joints[-1]
    world.connection.reset(world.now)
    assert world.run(6.0, until=lambda: world.connection.commanding)
    world.run(0.3)
    assert np.abs(world.joints[-1] - resting).max() < SAG
    world.swing(0.3)
    assert world.connection.commanding
    check(world)


@pytest.mark.parametrize(('faults', 'borne'), [
    ({'loss': 0.02}, True),
    ({'loss': 0.05}, True),
    ({'loss': 0.1}, None),
    ({'loss': 0.2}, None),
    ({'duplicates': 0.2}, True),
    ({'jitter': 0.002}, True),
    ({'jitter': 0.004}, None),
    ({'jitter': 0.008}, False),
    ({'loss': 0.05, 'duplicates': 0.2, 'jitter': 0.002}, None),
    ({'loss': 0.2, 'duplicates': 0.2, 'jitter': 0.008}, False),
])  # fmt: skip
def test_a_bad_network_is_borne_or_ends_command_mode(world, faults, borne):
    """None: it depends on the packets; loss counts on both ways, and so twice."""
    world.set_faults(LinkFaultParameters(**faults))
    world.swing(5.0)
    check(world)
    if borne is not None:
        assert world.connection.commanding == borne
    if not world.connection.commanding:
        recover(world)


@pytest.mark.parametrize('cycles', [1, 3, 5, 10, 40])
def test_bursts_of_losses_are_bridged_or_end_command_mode(world, cycles):
    world.set_faults(LinkFaultParameters(loss=1.0))
    world.swing(cycles * 0.005)
    world.set_faults(LinkFaultParameters())
    world.swing(1.0)
    check(world)
    # The account of the controller bears five in a row.
    assert world.connection.commanding == (cycles <= 5)
    if not world.connection.commanding:
        assert world.connection.fault in (Fault.FELL_BACK, Fault.SILENT)
        recover(world)


def test_a_dead_controller_is_noticed_and_its_return_moves_nothing(world):
    world.silent = True
    world.run(0.5)
    assert world.connection.fault is Fault.SILENT
    check(world)
    recover(world)


def test_a_controller_that_is_switched_on_anew_is_noticed(world):
    world.start_controller()
    world.swing(1.0)
    # Its first packets look like late ones; then its state speaks for itself.
    assert world.connection.fault in (Fault.RESTARTED, Fault.FELL_BACK, Fault.SILENT)
    check(world)
    recover(world)


@pytest.mark.parametrize('field', [
    'position', 'commanded', 'offset', 'torque', 'external_torque', 'gravity', 'safety_limits',
])  # fmt: skip
def test_a_number_that_is_none_ends_command_mode(world, field):
    def spoil(reading):
        value = getattr(reading, field)
        return reading._replace(**{field: np.full_like(value, np.nan)[()]})

    world.controller.tamper = spoil
    world.swing(0.2)
    assert world.connection.fault is Fault.UNFIT
    assert world.connection.cause == 'the arm is not fit: a measurement is no finite number'
    check(world)
    recover(world)


@pytest.mark.parametrize(('says', 'cause'), [
    ({'quality': 1}, 'the controller finds the link too poor'),
    ({'quality': 0}, 'the controller finds the link too poor'),
    ({'power': 0}, 'drives are off'),
    ({'power': 0x3F}, 'drives are off'),
    ({'error': 4}, 'the controller reports an error of a drive'),
    ({'warning': 1}, 'the controller reports a warning'),
    ({'control': 1}, 'the controller moves the arm by another law than was set'),
])  # fmt: skip
def test_what_the_controller_says_of_itself_ends_command_mode(world, says, cause):
    world.controller.tamper = lambda reading: reading._replace(**says)
    world.swing(0.2)
    assert world.connection.fault is Fault.UNFIT
    assert cause in world.connection.cause
    check(world)
    recover(world)


def test_a_brake_event_stops_the_arm_and_needs_operator_and_reset(world):
    world.swing(0.5)
    world.controller.fail('emergency stop', error=1)
    since = len(world.joints)
    world.swing(1.0)
    assert world.connection.fault in (Fault.FELL_BACK, Fault.UNFIT)
    assert world.moved(since + 20) < STILL
    check(world)
    # Without the operator a reset alone does not help.
    world.connection.reset(world.now)
    world.run(3.0)
    assert not world.connection.commanding
    assert world.controller.state == MONITOR
    assert world.moved(since + 20) < STILL
    world.controller.acknowledge()
    assert world.run(6.0, until=lambda: world.connection.commanding)


def test_a_driver_that_dies_brings_the_arm_to_rest_within_the_controllers_patience(world):
    world.swing(0.5)
    world.set_faults(LinkFaultParameters(loss=1.0))
    since = len(world.joints)
    world.run(1.0)
    assert world.controller.state == MONITOR
    assert world.controller.message == 'FRI: too many answers are missing'
    assert world.moved(since + 30) < STILL


@pytest.mark.parametrize('seed', [*range(4), *(pytest.param(n, marks=slow) for n in range(4, 20))])
def test_any_mixture_of_faults_leaves_the_laws_whole(seed):
    rng = np.random.default_rng(seed)
    world = FriWorld(seed=seed, handshake=('ros_control', 'fri_library')[seed % 2])
    world.to_command_mode()
    for _ in range(6):
        world.set_faults(LinkFaultParameters(
            loss=rng.choice([0.0, 0.05, 0.2]), duplicates=rng.choice([0.0, 0.3]),
            jitter=rng.choice([0.0, 0.003, 0.008]),
        ))  # fmt: skip
        match rng.integers(5):
            case 0:
                world.silent = True
            case 1:
                world.start_controller()
            case 2:
                world.controller.fail('brake', error=int(rng.integers(0, 3)))
            case 3:
                world.controller.tamper = lambda reading: reading._replace(power=0)
        world.swing(rng.uniform(0.02, 1.0), joint=int(rng.integers(7)))
        world.silent = False
        world.controller.tamper = lambda reading: reading
        if rng.random() < 0.5:
            world.controller.acknowledge()
        if rng.random() < 0.5:
            world.connection.reset(world.now)
        world.run(rng.uniform(0.0, 3.0))
        check(world)
    if world.phase is Phase.FAULT:
        recover(world)
