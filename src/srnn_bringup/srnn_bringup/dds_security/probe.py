# SPDX-License-Identifier: Apache-2.0
"""Tries what the middleware does with a keystore: python -m srnn_bringup.dds_security.probe.

Arguments are a valid keystore and one whose permissions are forged. The exit code is 0 if
the first one opens the domain and the second does not; otherwise a line says what is wrong.
"""

from collections.abc import Sequence
import os
from pathlib import Path
import re
import sys

import rclpy
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node

from srnn_bringup.dds_security.enclaves import COMMAND
from srnn_bringup.environment import security_arguments, security_variables


def main(keystores: Sequence[str]) -> int:
    """Enter the domain with the one and the other, and return the exit code."""
    valid, forged = map(Path, keystores)
    refusal = _refusal(valid)
    if refusal is not None:
        print(refusal)
        return 1
    if _refusal(forged) is None:
        print('it lets in whose permissions are not valid')
        return 1
    return 0


def _refusal(keystore: Path) -> str | None:
    """Return why the middleware does not let this process in, None if it does."""
    os.environ.update(security_variables(keystore))
    context = rclpy.Context()
    try:
        rclpy.init(args=security_arguments(COMMAND, keystore), context=context)
        node = Node(COMMAND, context=context, enable_rosout=False, start_parameter_services=False)
        node.destroy_node()
    except rclpy_implementation.RCLError as error:
        return _first_line(str(error))
    finally:
        rclpy.try_shutdown(context=context)
    return None


def _first_line(text: str) -> str:
    """Return the reason without what rcl writes around it."""
    return re.sub(r'^error creating node: |, at /.*$', '', text.strip().partition('\n')[0])


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
