# SPDX-License-Identifier: Apache-2.0
"""Nodes as real processes: how they start, speak and go."""

from collections.abc import Iterator
from pathlib import Path
import signal
import subprocess
import sys

import pytest
from std_msgs.msg import Float64MultiArray

SPEAKER = Path(__file__).parent / 'nodes' / 'speaker.py'
FAREWELL = -1.0
PATIENCE_S = 20.0

WAITING_LONG = f"""
import runpy
from srnn_node import settling
settling.FOUND_S = settling.LONGEST_S = 600.0
runpy.run_path({str(SPEAKER)!r}, run_name='__main__')
"""
"""The speaker, and a place where somebody comes all the time."""


@pytest.fixture
def speaker() -> Iterator:
    started = []

    def start(*parameters, program=(SPEAKER,)):
        given = [word for item in parameters for word in ('-p', item)]
        process = subprocess.Popen(
            [sys.executable, *program, '--ros-args', *given],
            stderr=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        return process

    yield start
    for process in started:
        if process.poll() is None:
            process.kill()
        process.communicate()


@pytest.fixture
def heard(bench):
    numbers = []
    bench.client('listener').create_subscription(
        Float64MultiArray,
        'forward_position_controller/commands',
        lambda msg: numbers.append(msg.data[0]),
        100,
    )
    return numbers


@pytest.mark.parametrize('number', [signal.SIGTERM, signal.SIGINT])
def test_a_signalled_node_says_farewell_and_exits_with_0(bench, heard, speaker, number):
    process = speaker('autostart:=true')
    bench.spin_until(lambda: heard)
    process.send_signal(number)
    bench.spin_until(lambda: process.poll() is not None)
    bench.spin_until(lambda: heard[-1] == FAREWELL)
    assert process.returncode == 0
    assert process.stderr.read() == ''


def test_a_node_that_waits_to_be_found_can_be_stopped(bench, heard, speaker):
    process = speaker('autostart:=true', program=('-c', WAITING_LONG))
    watcher = bench.client('watcher')
    topic = 'forward_position_controller/commands'
    bench.spin_until(lambda: watcher.count_publishers(topic))
    process.terminate()
    process.communicate(timeout=PATIENCE_S)
    assert (process.returncode, heard) == (0, [])


def test_a_node_that_breaks_says_farewell_and_why_and_exits_with_1(bench, heard, speaker):
    process = speaker('autostart:=true', 'dies_after:=50', 'rate:=100.0')
    bench.spin_until(lambda: heard)
    _, complaints = process.communicate(timeout=PATIENCE_S)
    bench.spin_until(lambda: heard[-1] == FAREWELL)
    assert process.returncode == 1
    assert complaints.splitlines()[-1] == 'Speaker: dies as it was told'
    assert 'Traceback' in complaints


def test_a_node_that_cannot_be_configured_says_why_in_one_line_and_exits_with_1(speaker):
    process = speaker('autostart:=true', 'rate:=-5.0')
    _, complaints = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 1
    last = complaints.splitlines()[-1]
    assert last.endswith('SpeakerParameters.rate = -5.0: must be > 0 and <= 1000 [Hz]')
    assert 'Traceback' not in complaints


def test_a_node_waits_to_be_configured_unless_told_otherwise(bench, heard, speaker):
    process = speaker()
    watcher = bench.client('watcher')
    bench.spin_until(lambda: 'speaker' in watcher.get_node_names())
    assert process.poll() is None
    assert watcher.count_publishers('forward_position_controller/commands') == 0
    process.terminate()
    process.communicate(timeout=PATIENCE_S)
    assert (process.returncode, heard) == (0, [])


@pytest.mark.parametrize(
    ('arguments', 'code', 'out', 'complaint'),
    [
        (['--help'], 0, 'rate: Ticks per second. (> 0 and <= 1000 [Hz])', ''),
        (['--hepl'], 2, '', "Speaker: unknown argument '--hepl'; try --help"),
        (['--ros-args', '--sneak'], 2, '', "Speaker: ['--sneak']; try --help"),
        (['--ros-args', '-p', 'autostart:=3'], 1, '', "'autostart' to '3' of type 'INTEGER'"),
    ],
)
def test_the_command_line_is_read_strictly(arguments, code, out, complaint):
    done = subprocess.run(
        [sys.executable, SPEAKER, *arguments], capture_output=True, text=True, timeout=PATIENCE_S
    )
    assert done.returncode == code
    assert out in done.stdout
    assert complaint in done.stderr
    assert len(done.stderr.splitlines()) <= 1
