# SPDX-License-Identifier: Apache-2.0
"""Health of one node → diagnostic_msgs/DiagnosticArray with one status."""

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from std_msgs.msg import Header

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.ros.stamp import stamp_to_msg


def to_msg(health: Health, node: str, stamp_ns: int) -> DiagnosticArray:
    """Return the message.

    Args:
        health: how the node is doing.
        node: its full name.
        stamp_ns: time of the message [ns of ROS time].

    """
    status = DiagnosticStatus(
        level=bytes([health.level]),
        name=str(node),
        message=str(health.message),
        values=[KeyValue(key=str(k), value=str(v)) for k, v in health.values.items()],
    )
    return DiagnosticArray(header=Header(stamp=stamp_to_msg(stamp_ns)), status=[status])


def from_msg(msg: DiagnosticArray) -> dict[str, Health]:
    """Return the health of every node in the message, by full name; figures are text.

    Raises:
        MessageError: a status has an unknown level.

    """
    return {
        status.name: Health(
            _level(status),
            status.message,
            {item.key: item.value for item in status.values},
        )
        for status in msg.status
    }


def _level(status: DiagnosticStatus) -> HealthLevel:
    number = status.level[0]
    try:
        return HealthLevel(number)
    except ValueError:
        valid = ', '.join(f'{int(level)} ({level.name})' for level in HealthLevel)
        raise MessageError(f'level = {number} of {status.name}: must be one of {valid}') from None
