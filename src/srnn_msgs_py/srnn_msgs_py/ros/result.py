# SPDX-License-Identifier: Apache-2.0
"""SegmentResult ↔ diagnostic_msgs/DiagnosticStatus."""

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros.mark_carrier import FIGURE

NAME = 'segment'

_LEVELS = {
    ResultCode.DONE: DiagnosticStatus.OK,
    ResultCode.BLOCKED: DiagnosticStatus.WARN,
    ResultCode.REJECTED: DiagnosticStatus.WARN,
    ResultCode.STALE: DiagnosticStatus.WARN,
    ResultCode.FAULT: DiagnosticStatus.ERROR,
}
_STAMP = 'segment_stamp_ns'
_REASON = 'reason'


def to_msg(result: SegmentResult) -> DiagnosticStatus:
    """Return the message of a result; figures travel as text that reads back exactly.

    Raises:
        MessageError: a figure has one of the names that the message itself needs.

    """
    taken = {_STAMP, _REASON, FIGURE}.intersection(result.values)
    if taken:
        raise MessageError(f'values has the keys {sorted(taken)}: these names are taken')
    values = {_STAMP: str(int(result.stamp_ns)), _REASON: str(result.reason)}
    values.update({str(key): repr(float(value)) for key, value in result.values.items()})
    return DiagnosticStatus(
        level=_LEVELS[result.code],
        name=NAME,
        message=result.code.value,
        values=[KeyValue(key=key, value=value) for key, value in values.items()],
    )


def from_msg(msg: DiagnosticStatus) -> SegmentResult:
    """Return the result of a message.

    Raises:
        MessageError: the code, the stamp or a figure cannot be read.

    """
    values = {item.key: item.value for item in msg.values if item.key != FIGURE}
    try:
        code = ResultCode(msg.message)
    except ValueError:
        valid = ', '.join(code.value for code in ResultCode)
        raise MessageError(f'message = {msg.message!r}: must be one of {valid}') from None
    try:
        stamp_ns = int(values.pop(_STAMP))
        reason = values.pop(_REASON)
        figures = {key: float(value) for key, value in values.items()}
    except KeyError as error:
        raise MessageError(f'values lack {error}; they have {", ".join(values)}') from None
    except ValueError as error:
        raise MessageError(f'values hold what is no number: {error}') from None
    return SegmentResult(stamp_ns, code, reason, figures)
