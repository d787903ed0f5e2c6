# SPDX-License-Identifier: Apache-2.0
"""What holds for every test: middleware on this host only, strict messages, stable examples."""

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


def pytest_addoption(parser: pytest.Parser) -> None:
    """Let the fault tests be short every day, and thorough when asked."""
    parser.addoption(
        '--injections', type=int, default=3, metavar='N',
        help='how often every fault is injected (default: %(default)s)',
    )
