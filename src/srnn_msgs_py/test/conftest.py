# SPDX-License-Identifier: Apache-2.0
"""Fixtures of the message tests."""

from collections.abc import Callable
from typing import Any

import pytest
from rclpy.serialization import deserialize_message, serialize_message


@pytest.fixture
def wire() -> Callable[[Any], Any]:
    """Send a message through the middleware's serialisation and back."""

    def send(msg: Any) -> Any:
        return deserialize_message(serialize_message(msg), type(msg))

    return send
