# SPDX-License-Identifier: Apache-2.0
from diagnostic_msgs.msg import DiagnosticStatus
from hypothesis import given
from hypothesis import strategies as st
import pytest
from rclpy.serialization import deserialize_message, serialize_message

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import diagnostics
from srnn_msgs_py.ros import result as results

TEXT = st.text(st.characters(codec='utf-8', exclude_characters='\0'), max_size=20)
FIGURES = st.dictionaries(
    TEXT.filter(lambda key: key not in ('segment_stamp_ns', 'reason')),
    st.floats(allow_nan=False),
    max_size=5,
)


@given(st.integers(0, 2**63), st.sampled_from(ResultCode), TEXT, FIGURES)
def test_results_come_back_from_the_wire(stamp, code, reason, values):
    result = SegmentResult(stamp, code, reason, values)
    sent = serialize_message(results.to_msg(result))
    assert results.from_msg(deserialize_message(sent, DiagnosticStatus)) == result


def test_only_done_is_ok_and_only_a_fault_is_an_error():
    levels = {code: results.to_msg(SegmentResult(1, code)).level for code in ResultCode}
    assert [c for c, level in levels.items() if level == DiagnosticStatus.OK] == [ResultCode.DONE]
    assert [c for c, x in levels.items() if x == DiagnosticStatus.ERROR] == [ResultCode.FAULT]


def test_figures_cannot_take_the_names_of_the_message():
    with pytest.raises(MessageError, match=r"\['reason'\]: these names are taken"):
        results.to_msg(SegmentResult(1, ResultCode.DONE, values={'reason': 1.0}))


def test_unreadable_results_are_refused_by_name():
    msg = results.to_msg(SegmentResult(1, ResultCode.BLOCKED, 'contact', {'force_n': 12.0}))
    msg.message = 'FINE'
    with pytest.raises(MessageError, match="'FINE': must be one of DONE, BLOCKED, REJECTED"):
        results.from_msg(msg)
    msg.message = 'BLOCKED'
    msg.values[2].value = 'strong'
    with pytest.raises(MessageError, match='strong'):
        results.from_msg(msg)
    del msg.values[0]
    with pytest.raises(MessageError, match='values lack .segment_stamp_ns.'):
        results.from_msg(msg)


@given(st.sampled_from(HealthLevel), TEXT, st.dictionaries(TEXT, TEXT, max_size=5))
def test_health_comes_back(level, message, values):
    health = Health(level, message, values)
    back = diagnostics.from_msg(diagnostics.to_msg(health, '/robot/tracker', 12))
    assert back == {'/robot/tracker': health}


def test_unknown_levels_are_refused_by_name():
    msg = diagnostics.to_msg(Health(), 'tracker', 12)
    msg.status[0].level = b'\x09'
    with pytest.raises(MessageError, match=r'level = 9 of tracker: must be one of 0 \(OK\)'):
        diagnostics.from_msg(msg)
