# SPDX-License-Identifier: Apache-2.0
"""The emulated controller, answered by hand-made commands."""

from fri_command import command
import numpy as np
import pytest

from lwr_description import POSITION_MAX, VELOCITY_MAX, Kinematics, Mount
from lwr_sim_bridge import ArmParameters, MismatchParameters, NoiseParameters, SimulatedArm
from lwr_sim_bridge.fri.answer_statistics import PERFECT
from lwr_sim_bridge.fri.controller import COMMAND, DRIVES_ON, MONITOR, FriController
from lwr_sim_bridge.fri.krl_program import KrlProgram
from lwr_sim_bridge.fri.parameters import ControllerParameters
from srnn_config.scene import Scene, SceneTask

CYCLE = 5
PERFECT_ARM = ArmParameters(
    mismatch=MismatchParameters(mass_scale=1.0, payload=0.0, friction=(0.0,) * 7),
    noise=NoiseParameters(scale=0.0),
)
SCENE = Scene(SceneTask('free'), waypoints=((0.0, 0.0),))
IMPEDANCE = {'flags': 0x35, 'stiffness': 1000.0, 'damping': 0.7}


def floats(data, offset, count):
    return np.frombuffer(data, '<f4', count, offset)


class Peer:
    """Answers every measurement with what a test wants.

    Attributes:
        heard: the newest measurement, as it was sent.
        fields: of every command, until changed.

    """

    def __init__(self, arm=PERFECT_ARM, strategy=30, **parameters):
        self.arm = SimulatedArm(arm, Mount(), SCENE, np.random.default_rng(1))
        self.controller = FriController(
            self.arm, Mount(), CYCLE, KrlProgram('fri_library'),
            ControllerParameters(**parameters),
        )
        self.fields = dict(IMPEDANCE, ints=[0] * 14 + [strategy, 20])
        self.now = 0.0

    def cycle(self, answer=True, latency=0.001, **fields):
        """Mirror, or say what `fields` say."""
        self.heard = self.controller.measure()
        self.controller.sent(self.now)
        mirrored = floats(self.heard, 292, 7) + floats(self.heard, 320, 7)
        if answer:
            said = {'position': mirrored, **self.fields, **fields}
            sequence = int.from_bytes(self.heard[:2], 'little')
            self.controller.receive(command(0, sequence, **said), self.now + latency)
        self.controller.advance()
        self.now += 0.001 * CYCLE

    def cycles(self, number, **fields):
        for _ in range(number):
            self.cycle(**fields)

    def wish(self, wanted):
        self.fields['ints'][15] = 10 if wanted else 20

    def to_command_mode(self):
        self.cycles(20)
        self.wish(True)
        self.cycles(15)
        assert self.controller.state == COMMAND, self.controller.message
        return self.controller.target.astype('<f4').astype(float)


@pytest.fixture
def peer():
    return Peer()


def test_it_stands_in_monitor_mode_and_says_so(peer):
    home = peer.arm.data.qpos.copy()
    peer.cycles(50)
    data = peer.heard
    assert len(data) == 916
    assert int.from_bytes(data[144:146], 'little') == MONITOR
    assert int.from_bytes(data[146:148], 'little') == PERFECT
    assert int.from_bytes(data[180:182], 'little') == DRIVES_ON
    assert floats(data, 148, 3) == pytest.approx([0.005, 0.005, 1.0])
    assert floats(data, 160, 2) == pytest.approx([1.0, 0.001])
    assert np.allclose(floats(data, 216, 7), home, atol=1e-4)
    gravity = Kinematics(Mount()).gravity(home)
    assert np.allclose(floats(data, 888, 7), gravity, atol=1e-2)
    assert np.allclose(floats(data, 444, 7), gravity, atol=1e-2)
    assert np.abs(floats(data, 472, 7)).max() < 0.05


def test_in_monitor_mode_nothing_that_is_sent_moves_it(peer):
    home = peer.arm.data.qpos.copy()
    for k in range(100):
        peer.cycle(position=home + 0.01 * k)
    assert np.abs(peer.arm.data.qpos - home).max() < 1e-4
    assert peer.controller.message == ''


@pytest.mark.parametrize('joint', range(7))
def test_each_joint_alone_goes_where_it_is_told_in_its_direction(peer, joint):
    position = peer.to_command_mode()
    before = peer.arm.data.qpos.copy()
    for _ in range(100):
        position[joint] += 0.001
        peer.cycle(position=position)
    peer.cycles(50, position=position)
    expected = np.where(np.arange(7) == joint, 0.1, 0.0)
    assert np.allclose(peer.arm.data.qpos - before, expected, atol=1e-3)
    peer.cycle(position=position)
    assert np.allclose(floats(peer.heard, 216, 7) - before, expected, atol=1e-3)
    # What is commanded is the pose before command mode and the way from there.
    assert np.allclose(floats(peer.heard, 292, 7), before, atol=1e-4)
    assert np.allclose(floats(peer.heard, 320, 7), expected, atol=1e-4)


def test_external_torques_have_the_sign_of_the_push_and_the_wrench_its_order(peer):
    position = peer.to_command_mode()
    force = np.array([0.0, 0.0, -20.0])
    jacobian = Kinematics(Mount()).jacobian(position)
    peer.arm.data.qfrc_applied[:] = jacobian.T @ force
    peer.cycles(100, position=position)
    assert np.allclose(floats(peer.heard, 472, 7), jacobian.T @ force, atol=0.3)
    # Down in the world is ahead of a base whose axis points ahead: its -x is up.
    fx, fy, fz, tz, ty, tx = floats(peer.heard, 500, 6)
    assert [fx, fy, fz] == pytest.approx([20.0, 0.0, 0.0], abs=1.5)
    assert np.abs([tx, ty, tz]).max() < 1.0
    shown = floats(peer.heard, 524, 42).reshape(6, 7)
    assert np.allclose(shown[[0, 1, 2, 5, 4, 3]].T @ [fx, fy, fz, tx, ty, tz],
                       floats(peer.heard, 472, 7), atol=0.1)  # fmt: skip


def test_a_soft_joint_yields_more_to_the_same_push(peer):
    position = peer.to_command_mode()
    peer.arm.data.qfrc_applied[3] = 5.0
    sag = []
    for stiffness in (1000.0, 200.0):
        peer.cycles(200, position=position, stiffness=stiffness)
        sag.append(peer.arm.data.qpos[3] - position[3])
    assert sag == pytest.approx([0.005, 0.025], rel=0.05)


def test_isolated_misses_are_extrapolated(peer):
    position = peer.to_command_mode()
    for k in range(100):
        position[3] += 0.002
        peer.cycle(answer=k % 10 != 5, position=position)
        assert np.allclose(peer.controller.target, position, atol=1e-6)
    assert peer.controller.state == COMMAND
    assert peer.controller.statistics.misses == 10


def test_too_many_misses_end_command_mode_where_the_arm_is(peer):
    position = peer.to_command_mode()
    for _ in range(50):
        position[3] += 0.002
        peer.cycle(position=position)
    peer.cycles(5, answer=False)
    assert peer.controller.state == COMMAND
    peer.cycle(answer=False)
    assert (peer.controller.state, peer.controller.power) == (MONITOR, 0)
    assert peer.controller.message == 'FRI: too many answers are missing'
    rest = peer.controller.target
    peer.cycles(100)
    assert np.abs(peer.arm.data.qpos - rest).max() < 1e-3


def test_an_answer_to_an_older_packet_is_a_miss(peer):
    peer.cycles(30)
    old = command(0, int.from_bytes(peer.heard[:2], 'little'), **peer.fields)
    peer.controller.measure()
    peer.controller.receive(old, peer.now)
    misses = peer.controller.statistics.misses
    peer.controller.advance()
    assert peer.controller.statistics.misses == misses + 1
    assert peer.controller.late == 1
    peer.controller.receive(b'garbage', peer.now)
    assert peer.controller.rejected == 1


@pytest.mark.parametrize(('fields', 'message'), [
    ({'position': lambda q: q + 0.01}, 'the command is not where the arm is held'),
    ({'position': lambda q: np.nan}, 'a number of the command is none'),
    ({'torque': lambda q: 2.0}, 'cmd.addJntTrq not properly initialized'),
    ({'flags': lambda q: 0x30}, 'no joint positions in the command'),
])  # fmt: skip
def test_command_mode_does_not_begin_from_a_wrong_command(peer, fields, message):
    peer.cycles(30)
    peer.wish(True)
    peer.fields |= {name: make(peer.controller.target) for name, make in fields.items()}
    peer.cycles(15)
    assert peer.controller.state == MONITOR
    assert message in peer.controller.message
    # Not before the operator has acknowledged and the program was told to stop.
    peer.fields = dict(IMPEDANCE, ints=peer.fields['ints'])
    peer.cycles(50)
    peer.controller.acknowledge()
    peer.cycles(50)
    assert peer.controller.state == MONITOR
    peer.wish(False)
    peer.cycles(15)
    peer.wish(True)
    peer.cycles(15)
    assert peer.controller.state == COMMAND


@pytest.mark.parametrize(('fields', 'message'), [
    ({'position': lambda q: q + 1.01 * 0.005 * VELOCITY_MAX[3] * np.eye(7)[3]}, 'joint speed'),
    ({'position': lambda q: np.inf}, 'a number of the command is none'),
    ({'flags': lambda q: 0x01}, 'flags have changed in command mode'),
    ({'stiffness': lambda q: 2100.0}, 'stiffness or damping out of range'),
    ({'damping': lambda q: 0.0}, 'stiffness or damping out of range'),
])  # fmt: skip
def test_a_command_that_may_not_be_followed_ends_command_mode(peer, fields, message):
    position = peer.to_command_mode()
    peer.cycle(position=position + 0.99 * 0.005 * VELOCITY_MAX[3] * np.eye(7)[3])
    assert peer.controller.state == COMMAND
    peer.cycle(position=position)
    wrong = {name: make(position) for name, make in fields.items()}
    peer.cycle(**{'position': position, **wrong})
    assert peer.controller.state == MONITOR
    assert message in peer.controller.message


def test_a_joint_is_not_commanded_beyond_its_limit(peer):
    position = peer.to_command_mode()
    while peer.controller.state == COMMAND and position[6] < POSITION_MAX[6] + 0.1:
        position[6] += 0.01
        peer.cycle(position=position)
    assert peer.controller.message == 'FRI: a joint is commanded beyond its limit'
    assert peer.arm.data.qpos[6] < POSITION_MAX[6]


def test_half_the_limits_is_half_the_step():
    peer = Peer(velocity_share=0.5)
    position = peer.to_command_mode()
    assert floats(peer.heard, 156, 1) == 0.5
    peer.cycle(position=position + 0.51 * 0.005 * VELOCITY_MAX)
    assert 'joint speed' in peer.controller.message


def test_leaving_command_mode_keeps_the_pose_and_the_way_to_it():
    peer = Peer(ArmParameters(noise=NoiseParameters(scale=0.0)))
    position = peer.to_command_mode()
    for _ in range(100):
        position[1] += 0.001
        peer.cycle(position=position)
    peer.cycles(100, position=position)
    peer.wish(False)
    peer.cycles(15, position=position)
    assert (peer.controller.state, peer.controller.message) == (MONITOR, '')
    assert peer.controller.power == DRIVES_ON
    before = peer.arm.data.qpos.copy()
    peer.cycles(100)
    assert np.abs(peer.arm.data.qpos - before).max() < 1e-3
    # It sags: what is measured is not what is commanded, which is what must be mirrored.
    assert np.abs(floats(peer.heard, 216, 7) - position).max() > 5e-4
    mirrored = floats(peer.heard, 292, 7) + floats(peer.heard, 320, 7)
    assert np.allclose(mirrored, position, atol=1e-6)
