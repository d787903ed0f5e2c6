# SPDX-License-Identifier: Apache-2.0
"""A configuration and a recorder for every test."""

import pytest

from srnn_bringup.config import Choices, Configuration, load
from srnn_bringup.run_recorder import Recorder, start_recording


@pytest.fixture(scope='session')
def configuration() -> Configuration:
    return load(Choices())


@pytest.fixture
def recorder(configuration: Configuration) -> Recorder:
    return start_recording(configuration)
