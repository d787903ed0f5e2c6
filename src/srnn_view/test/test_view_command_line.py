# SPDX-License-Identifier: Apache-2.0
"""The view as a process that was started by hand."""

import subprocess
import sys

import pytest

TIME_S = 30.0


@pytest.mark.parametrize(
    ('arguments', 'code', 'out', 'complaint'),
    [
        (['--help'], 0, 'scene: Scene file with the obstacles to be drawn. (required)', ''),
        (['--port', '80'], 2, '', "view: unknown argument '--port'; try --help"),
        ([], 1, '', 'view: missing scene; try --help'),
    ],
)
def test_the_command_line_is_read_strictly(arguments, code, out, complaint):
    command = [sys.executable, '-m', 'srnn_view.view_node', *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=TIME_S)
    assert done.returncode == code
    assert out in done.stdout
    assert done.stderr.strip() == complaint
