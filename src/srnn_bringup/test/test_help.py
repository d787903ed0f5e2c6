# SPDX-License-Identifier: Apache-2.0
"""What the help of every command shows."""

import argparse
from ipaddress import ip_address
import shlex

import pytest

from srnn_bringup import cli
from srnn_bringup.examples import EXAMPLES
from srnn_bringup.sections import SECTIONS

ROOT, COMMANDS = cli.parsers()
LOOPBACK = ip_address('127.0.0.1')
ALL = {'': ROOT, **COMMANDS}
LINES = [line for examples in EXAMPLES.values() for line in examples]


def shown(command):
    """Return the help of a command, without its line breaks."""
    return ' '.join(ALL[command].format_help().split())


def options(parser):
    return [a for a in parser._actions if a.option_strings and a.dest != 'help']


def test_every_command_has_two_or_three_examples_and_its_help_shows_them():
    assert EXAMPLES.keys() == ALL.keys()
    for command, examples in EXAMPLES.items():
        assert 2 <= len(examples) <= 3
        assert all(f' {line} {purpose}' in shown(command) for line, purpose in examples.items())
        assert any(line.startswith(f'srnn {command}'.rstrip()) for line in examples)


@pytest.mark.parametrize('line', sorted(set(LINES)))
def test_every_example_is_understood(line, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    # The examples name hosts of documentation, to which no way need lead.
    monkeypatch.setattr('srnn_bringup.peers._own_address', lambda text, address: LOOPBACK)
    for name in ('learned.npz', 'without.npz', 'both.npz', 'graph.key'):
        (tmp_path / name).touch()
    (tmp_path / 'keystore').mkdir()
    program, *words = shlex.split(line.partition('>')[0])
    assert program == 'srnn'
    parser, _ = cli.parsers()
    told, unknown = parser.parse_known_args([word for word in words if word != '--help'])
    assert not unknown
    assert callable(told.run)


def test_examples_of_keys_and_keystores_do_what_they_say(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for command in ('key', 'keystore'):
        make, *_ = EXAMPLES[command]
        assert cli.main(shlex.split(make)[1:]) == 0
    assert (tmp_path / 'graph.key').is_file()
    assert (tmp_path / 'keystore' / 'enclaves').is_dir()


@pytest.mark.parametrize('command', sorted(COMMANDS))
def test_every_default_is_shown(command):
    nothing = (None, False, [], (), argparse.SUPPRESS)
    for action in options(COMMANDS[command]):
        if action.default not in nothing:
            assert '(default: %(default)s' in action.help, action.option_strings


def test_options_stand_in_the_same_section_everywhere():
    for command, parser in COMMANDS.items():
        titles = {a: g.title for g in parser._action_groups for a in g._group_actions}
        for action in options(parser):
            (name,) = [o for o in action.option_strings if o.startswith('--')]
            assert name in SECTIONS[titles[action]], (command, name)


def test_every_option_that_has_a_section_exists():
    there = {o for parser in COMMANDS.values() for a in parser._actions for o in a.option_strings}
    assert {name for names in SECTIONS.values() for name in names} <= there


def test_exit_codes_are_in_the_help_of_every_command():
    assert all('exit codes: 0 done; 1 failed' in shown(command) for command in ALL)
