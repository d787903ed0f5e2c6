# SPDX-License-Identifier: Apache-2.0
"""What a shell offers after `srnn completion` was read by it."""

import shutil
import subprocess

import pytest

from srnn_bringup import cli

ASK = """\
source "$1"
COMP_WORDS=("${@:2}") COMP_CWORD=$(($# - 2))
_shtab_srnn
printf '%s\\n' "${COMPREPLY[@]}"
"""
"""Asks as bash does when Tab is hit behind the last word."""

WAIT_S = 60.0


@pytest.fixture(scope='module')
def script(tmp_path_factory):
    def make(shell):
        with pytest.MonkeyPatch.context() as patch:
            said = []
            patch.setattr('builtins.print', said.append)
            assert cli.main(['completion', shell]) == 0
        path = tmp_path_factory.mktemp(shell) / '_srnn'
        path.write_text(said[0])
        return path

    return make


@pytest.fixture(scope='module')
def offered(script):
    path = script('bash')

    def ask(*words, cwd=None):
        command = ['bash', '--norc', '-uc', ASK, 'bash', str(path), 'srnn', *words]
        done = subprocess.run(command, capture_output=True, text=True, timeout=WAIT_S, cwd=cwd)
        return done.stdout.split()

    return ask


@pytest.mark.parametrize(
    ('words', 'expected'),
    [
        (['de'], {'demo'}),
        (['re'], {'resume', 'record', 'replay', 'report'}),
        (['experiment', 't'], {'table1', 'transfer'}),
        (['demo', '--si'], {'--signal'}),
        (['demo', '--signal', ''], {'none', 'global', 'local', 'constant', 'untriggered'}),
        (['up', '--arm', 'f'], {'fri'}),
        (['belief', 'diff', '--p'], {'--picture'}),
        (['completion', ''], {'bash', 'zsh'}),
        (['up', '--scene', 'wa'], {'wall'}),
        (['demo', '--arm-description', ''], {'lwr4p', 'ur5e'}),
        (['experiment', 'run', '--arm-description', 'u'], {'ur5e'}),
        (['up', '--network', 'network_p'], {'network_paper'}),
        (['nothing', '--si'], set()),
    ],
)
def test_bash_offers_what_can_be_said_there(words, expected, offered, tmp_path):
    assert set(offered(*words, cwd=tmp_path)) == expected


def test_bash_offers_every_command_and_every_option(offered, tmp_path):
    _, commands = cli.parsers()
    assert set(offered('', cwd=tmp_path)) == {name for name in commands if ' ' not in name}
    for name, parser in commands.items():
        options = {o for a in parser._actions for o in a.option_strings}
        assert set(offered(*name.split(), '-', cwd=tmp_path)) == options


def test_bash_offers_files_where_one_is_asked_for(offered, tmp_path):
    (tmp_path / 'learned.npz').touch()
    assert offered('up', '--weights', 'lea', cwd=tmp_path) == ['learned.npz']
    assert offered('up', '--scene', 'lea', cwd=tmp_path) == ['learned.npz']
    assert offered('up', '--arm-description', 'lea', cwd=tmp_path) == ['learned.npz']


@pytest.mark.skipif(shutil.which('zsh') is None, reason='zsh is not installed')
def test_zsh_reads_its_script_and_knows_the_commands(script):
    path = script('zsh')
    ask = (
        'autoload -U compinit && compinit -D -u; eval "$(<$1)"; print -l $_comps[srnn]; '
        'functions _shtab_srnn_commands _srnn_arm; print -l $_shtab_srnn_demo_options'
    )
    done = subprocess.run(
        ['zsh', '-fc', ask, 'zsh', str(path)], capture_output=True, text=True, timeout=WAIT_S
    )
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout.startswith('_shtab_srnn')
    _, commands = cli.parsers()
    assert all(f'{name}:' in done.stdout for name in commands if ' ' not in name)
    assert '--signal[' in done.stdout
    assert ':DESCRIPTION:_srnn_arm' in done.stdout
    assert "'arms:arm:(lwr4p ur5e)' 'files:file:_files'" in done.stdout
