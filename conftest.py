# SPDX-License-Identifier: Apache-2.0
"""What holds for every test: middleware on this host only, strict messages, stable examples."""

import gc
from importlib.util import find_spec
import os
from pathlib import Path
import tempfile

from hypothesis import settings
import pytest

# Read when rclpy and the message packages are imported, hence before any fixture.
os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
os.environ['ROS_PYTHON_CHECK_FIELDS'] = '1'
os.environ['ROS_DOMAIN_ID'] = str(1 + os.getpid() % 100)
os.environ['ROS_LOG_DIR'] = str(Path(tempfile.gettempdir()) / 'srnn_test_logs')
os.environ['OPENBLAS_NUM_THREADS'] = '1'

settings.register_profile('workspace', deadline=None, derandomize=True, database=None)
settings.load_profile('workspace')


@pytest.fixture(autouse=True, scope='session')
def profile_of_the_graph() -> None:
    """Have the middleware read the profile of the graph, as it does once in every process.

    Whichever test comes first would decide otherwise how soon later ones find a node. Where
    colcon tests a package beside those alone that it depends on, there may be no graph.
    """
    if find_spec('srnn_bringup') is None:
        return
    import rclpy

    from srnn_bringup.environment import graph_environment

    with pytest.MonkeyPatch.context() as patch:
        for name, value in graph_environment(os.environ).items():
            patch.setenv(name, value)
        rclpy.init(args=[])
        rclpy.create_node('first').destroy_node()
        rclpy.shutdown()


@pytest.fixture(autouse=True, scope='module')
def nothing_left() -> None:
    """Let no node of the module before live on: others in the domain would still see it.

    A node that was active has kept the collector out, and nodes are full of cycles. The last
    test of a module holds its fixtures until the next one begins.
    """
    gc.unfreeze()
    gc.enable()
    gc.collect()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Let fault tests be short every day, and have pictures for the documentation made."""
    parser.addoption(
        '--injections', type=int, default=3, metavar='N',
        help='how often every fault is injected (default: %(default)s)',
    )
    parser.addoption(
        '--screenshots', metavar='DIR',
        help='existing directory for pictures of the live view (default: a temporary one)',
    )
