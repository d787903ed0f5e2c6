# SPDX-License-Identifier: Apache-2.0
"""Where libraries are missing, `srnn` still tells what is missing."""

import os
import subprocess
import sys

import pytest

HEAVY = ('numba', 'mujoco', 'rclpy')
"""What takes long to import; a command line is read without it."""

MISSING = (*HEAVY, 'numpy', 'yaml', 'mcap', 'matplotlib', 'cryptography')
WAIT_S = 120.0


def without(names, stand_ins):
    """Return how to run the command where none of these libraries can be imported."""
    for name in names:
        (stand_ins / f'{name}.py').write_text(f'raise ImportError("no {name} here")\n')
    path = os.pathsep.join(filter(None, [str(stand_ins), os.environ.get('PYTHONPATH')]))

    def run(*words):
        return subprocess.run(
            [sys.executable, '-m', 'srnn_bringup.cli', *words], text=True, capture_output=True,
            env={**os.environ, 'PYTHONPATH': path}, timeout=WAIT_S,
        )  # fmt: skip

    return run


@pytest.fixture(scope='module')
def srnn(tmp_path_factory):
    return without(MISSING, tmp_path_factory.mktemp('missing'))


def test_the_doctor_says_what_is_missing_and_what_to_do(srnn):
    done = srnn('doctor')
    assert (done.returncode, done.stderr) == (1, '')
    lines = {line[6:28].strip(): line for line in done.stdout.splitlines()}
    for name in MISSING:
        assert f'cannot be imported: no {name} here; to do: run make setup' in lines[name]
        assert lines[name].startswith('FAIL')
    assert 'first mend what cannot be imported' in lines['configuration']


@pytest.mark.parametrize(
    'words', [['--help'], ['doctor', '--help'], ['pause', '--help'], ['key', 'create', '--help']]
)
def test_help_is_there(words, srnn):
    done = srnn(*words)
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout.startswith('usage: srnn')


@pytest.mark.parametrize('words', [['up'], ['belief', 'list', 'run'], ['experiment', '--help']])
def test_every_other_command_names_what_is_missing_and_the_doctor(words, srnn):
    done = srnn(*words)
    assert (done.returncode, done.stdout) == (1, '')
    assert done.stderr.startswith('srnn: no ')
    assert done.stderr.endswith(' here; `srnn doctor` says what is missing\n')
    assert done.stderr.count('\n') == 1


@pytest.mark.parametrize('words', [['completion', 'bash'], ['experiment', 'run', '--help']])
def test_a_command_line_is_read_without_what_takes_long_to_import(words, tmp_path):
    done = without(HEAVY, tmp_path)(*words)
    assert (done.returncode, done.stderr) == (0, '')
    assert '--arm-description' in done.stdout
