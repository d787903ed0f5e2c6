# SPDX-License-Identifier: Apache-2.0
import io

import pytest
from synthetic_run import Player, planner_health

from srnn_bringup.console import Console
from srnn_msgs_py.result import ResultCode, SegmentResult


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def played(recorder, configuration):
    points = configuration.scene.waypoints
    recorder.health(planner_health(planned=1, planning_ms=1.44, segment_stamp_ns=1))
    player = Player(recorder)
    player.go(points[0], duration=0.5)
    player.touch((0.1, -0.1))
    for point in points[1:]:
        player.go(point)
    return recorder


def printed(records, out):
    console = Console(out)
    console.heading()
    for record in records:
        console.segment(record)
    return out.getvalue()


def test_one_line_per_segment_with_its_figures(played):
    lines = printed(played.records, io.StringIO()).splitlines()
    segments = [line.split() for line in lines if line[:7].strip().isdecimal()]
    assert [cells[0] for cells in segments] == ['1', '2', '3', '4', '5']
    assert segments[0][1:] == ['1', '1.4', 'ms', '0', 'mm', '0.50', 's', 'done', '0.000', '0']
    assert segments[1][-3:] == ['touched', '0.300', '1']
    assert segments[1][2] == '-'


def test_events_are_told_in_words(played):
    text = printed(played.records, io.StringIO())
    assert 'touch 1: 14 N at (0.04, -0.05); learned, weights version 1' in text
    assert text.count('reached') == 4
    assert 'way point 2 reached' in text
    assert 'lap 1' in text


def test_columns_stand_under_their_names(played):
    lines = printed(played.records[:1], io.StringIO()).splitlines()
    assert len(lines[0]) == len(lines[1])


def test_refusals_are_told_with_their_reason():
    out = io.StringIO()
    Console(out).refused(SegmentResult(1, ResultCode.REJECTED, 'too fast'))
    assert 'too fast' in out.getvalue()


def test_faults_are_told_with_their_reason(recorder):
    player = Player(recorder)
    player._play((0.1, 0.0), 0.0, ResultCode.FAULT, False, 1.0)
    assert 'fault: force' in printed(recorder.records, io.StringIO())


def test_colour_is_for_terminals_only(played):
    assert '\033' not in printed(played.records, io.StringIO())
    assert '\033' in printed(played.records, Terminal())
