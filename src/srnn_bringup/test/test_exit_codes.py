# SPDX-License-Identifier: Apache-2.0
"""What the exit code of a command tells."""

from pathlib import Path
import signal
import subprocess
import sys

import pytest

from srnn_bringup import cli
from srnn_bringup.errors import ChoiceError
from srnn_bringup.exit_codes import DONE, FAILED, WRONG_USE, by_signal

DOCUMENT = Path(__file__).parents[3] / 'docs' / 'command_line.md'


@pytest.mark.parametrize(
    ('event', 'code', 'words'),
    [
        (ChoiceError('no such thing'), 2, 'srnn up: no such thing\n'),
        (OSError('disk full'), 1, 'srnn up: disk full\n'),
        (KeyboardInterrupt(), 130, ''),
    ],
)
def test_an_error_becomes_a_line_and_a_code(event, code, words, monkeypatch, capsys):
    def run(*_):
        raise event

    monkeypatch.setattr('srnn_bringup.up.run_up', run)
    assert cli.main(['up']) == code
    assert capsys.readouterr() == ('', words)


@pytest.mark.parametrize('name', ['SIGKILL', 'SIGTERM', 'SIGPIPE'])
def test_a_signal_is_told_as_the_shell_tells_it(name):
    end = subprocess.run(['bash', '-c', f'(kill -s {name[3:]} $BASHPID); exit $?'])
    assert by_signal(name) == end.returncode == 128 + signal.Signals[name]


def test_a_reader_that_has_had_enough_is_no_failure():
    srnn = f'"{sys.executable}" -m srnn_bringup.cli'
    command = f'{srnn} completion bash | true; exit ${{PIPESTATUS}}'
    end = subprocess.run(['bash', '-c', command], capture_output=True, text=True, timeout=120)
    assert (end.returncode, end.stderr) == (by_signal('SIGPIPE'), '')


def test_the_documentation_tells_every_code():
    rows = [line for line in DOCUMENT.read_text().splitlines() if line.startswith('| `')]
    codes = {row.split('`')[1] for row in rows}
    assert {str(DONE), str(FAILED), str(WRONG_USE), '128 + n'} <= codes
