# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from std_msgs.msg import Empty, Float64MultiArray, Header, MultiArrayDimension

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import commands, executed, pose, result, segment, weights
from srnn_msgs_py.ros.mark_carrier import mark_carrier, plain_frame
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.segment import FRAME, ExecutedPath, Segment
from srnn_msgs_py.tip import TipPosition
from srnn_msgs_py.topics import TOPICS
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate

TEXT = '0123456789abcdef.17'
OWNED = [row for row in TOPICS if row.ownership]
every_owned = pytest.mark.parametrize('row', OWNED, ids=lambda row: row.name)


def marked(msg):
    mark_carrier(type(msg)).put(msg, TEXT)
    return msg


@every_owned
def test_a_mark_comes_out_as_it_went_in_and_leaves_nothing_behind(row):
    kind = message_type(row.type_name)
    carrier, msg = mark_carrier(kind), kind()
    assert carrier.take(msg) is None
    assert marked(msg) != kind()
    assert carrier.take(msg) == TEXT
    assert msg == kind()


def test_a_joint_command_reads_as_before():
    msg = marked(commands.to_msg(np.arange(7.0)))
    assert msg.data.tolist() == [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    assert commands.from_msg(msg, 7).tolist() == msg.data.tolist()


def test_whoever_reads_a_marked_message_sees_the_same_value():
    times, points = np.array([0.0, 0.5]), np.zeros((2, 2))
    plan = segment.from_msg(marked(segment.to_msg(Segment(5, times, points, points, points))))
    assert (plan.stamp_ns, plan.frame) == (5, FRAME)
    path = executed.from_msg(marked(executed.to_msg(ExecutedPath(5, times, points))))
    assert path.frame == FRAME
    tip = pose.from_msg(marked(pose.to_msg(TipPosition(5, np.zeros(3)))))
    assert tip.frame == FRAME
    ended = SegmentResult(5, ResultCode.DONE, 'because', {'peak': 0.5})
    assert result.from_msg(marked(result.to_msg(ended))) == ended
    update = WeightsUpdate(3, 5, LearnedWeights(4, 7, np.arange(3), np.ones(3, np.float32)))
    assert weights.from_msg(marked(weights.to_msg(update))).version == 3


def test_no_figure_of_a_result_can_pass_for_a_mark():
    with pytest.raises(MessageError, match="the keys \\['mark'\\]: these names are taken"):
        result.to_msg(SegmentResult(5, ResultCode.DONE, '', {'mark': 1.0}))


@pytest.mark.parametrize(
    ('frame', 'plain'),
    [
        ('', ''), ('map', 'map'), (f'map#{TEXT}', 'map'), (f'a#b#{TEXT}', 'a#b'), (f'#{TEXT}', ''),
        ('#', '#'), ('map#1', 'map#1'), (f'map#{TEXT}x', f'map#{TEXT}x'), (TEXT, ''),
    ],
)  # fmt: skip
def test_the_frame_is_what_stands_before_the_mark(frame, plain):
    assert plain_frame(Header(frame_id=frame)) == plain


@pytest.mark.parametrize('size', [0, 2])
def test_a_dimension_that_holds_data_is_no_mark(size):
    msg = Float64MultiArray()
    msg.layout.dim.append(MultiArrayDimension(label=f'mark={TEXT}', size=size, stride=1))
    assert mark_carrier(Float64MultiArray).take(msg) is None
    assert len(msg.layout.dim) == 1


def test_a_message_without_a_place_for_a_mark_is_refused():
    with pytest.raises(MessageError, match='Empty has no place for a mark: needs header'):
        mark_carrier(Empty)
