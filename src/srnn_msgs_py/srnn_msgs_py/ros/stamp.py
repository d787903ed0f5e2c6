# SPDX-License-Identifier: Apache-2.0
"""Times and durations of messages as whole nanoseconds."""

from builtin_interfaces.msg import Duration, Time

from srnn_msgs_py.errors import MessageError

SECOND_NS = 1_000_000_000
_LIMIT_S = 2**31


def stamp_to_msg(stamp_ns: int) -> Time:
    """Return nanoseconds as a message time.

    Raises:
        MessageError: the number of seconds does not fit 32 bits.

    """
    sec, nanosec = _split(stamp_ns)
    return Time(sec=sec, nanosec=nanosec)


def stamp_from_msg(msg: Time) -> int:
    """Return a message time in nanoseconds [ns]."""
    return int(msg.sec) * SECOND_NS + int(msg.nanosec)


def duration_to_msg(duration_ns: int) -> Duration:
    """Return nanoseconds as a message duration; errors as in `stamp_to_msg`."""
    sec, nanosec = _split(duration_ns)
    return Duration(sec=sec, nanosec=nanosec)


def duration_from_msg(msg: Duration) -> int:
    """Return a message duration in nanoseconds [ns]."""
    return int(msg.sec) * SECOND_NS + int(msg.nanosec)


def _split(time_ns: int) -> tuple[int, int]:
    sec, nanosec = divmod(int(time_ns), SECOND_NS)
    if not -_LIMIT_S <= sec < _LIMIT_S:
        raise MessageError(
            f'time = {time_ns} ns: must be {-_LIMIT_S} s or more and below {_LIMIT_S} s'
        )
    return sec, nanosec
