# SPDX-License-Identifier: Apache-2.0
"""Message classes by the type names of the topic table."""

from importlib import import_module
from typing import Any

from srnn_msgs_py.errors import MessageError


def message_type(type_name: str) -> Any:
    """Return the class of a type name, for example ``std_msgs/msg/Float64MultiArray``.

    Raises:
        MessageError: no installed package has this type.

    """
    package, _, name = type_name.partition('/msg/')
    try:
        return getattr(import_module(f'{package}.msg'), name)
    except (ImportError, AttributeError):
        raise MessageError(f'{type_name!r} is no message type of an installed package') from None
