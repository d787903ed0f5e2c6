# SPDX-License-Identifier: Apache-2.0
"""The walks of a stranger: what fails a walk, what of an output is shown, and that the page is of
the walks that there are.
"""

import os
from pathlib import Path
import re
import signal
import sys

from documented import ROOT
import pytest

sys.path.insert(0, str(ROOT / 'bench'))
from walk import Done, Shell, Step, StepFailedError, Walk
from walk_page import Walked, page
from walk_steps import WALKS
from walk_transcript import HEAD, TAIL, WIDTH, Cleaner, commands, shortened
from walks import LIMIT_S, environment

PAGE = ROOT / 'docs' / 'walks.md'
CLEANER = Cleaner({'/tmp/home_1': '~', 'box7': 'HOST'}, frozenset({'opt', 'tmp', 'home'}))


@pytest.fixture
def shell(tmp_path):
    return Shell(tmp_path, {'PATH': os.environ['PATH']}, {'WORD': 'a b'}, say=lambda _: None)


def walk(shell, *steps):
    return list(shell.walk(steps))


def test_what_is_typed_in_is_done_at_home_with_nothing_inherited(shell, tmp_path, monkeypatch):
    monkeypatch.setenv('MINE', 'seen')
    (done,) = walk(shell, Step('', 'echo $HOME ${MINE:-unseen}; pwd', 'unseen'))
    assert done.output == f'{tmp_path} unseen\n{tmp_path}\n'


def test_only_what_is_kept_changes_the_shell(shell, tmp_path):
    done = walk(
        shell,
        Step('', 'mkdir in'),
        Step('', 'cd in && export KEPT=1', kept=True),
        Step('', 'cd .. && export LOST=1'),
        Step('', 'pwd; echo ${KEPT:-no} ${LOST:-no}'),
    )
    assert done[-1].output == f'{tmp_path}/in\n1 no\n'


def test_words_stand_for_what_the_machine_has(shell):
    (done,) = walk(shell, Step('', 'printf "%s\\n" WORD WORDS'))
    assert done.output == 'a b\nWORDS\n'


def test_where_any_exit_code_is_good_the_one_that_came_is_told(shell):
    (done,) = walk(shell, Step('', 'exit 15', code=None))
    assert done.code == 15


def test_an_output_is_what_was_printed(shell):
    (done,) = walk(shell, Step('', "printf '1 of 2\\r2 of 2\\n\\xff'"))
    assert done.output == '1 of 2\r2 of 2\n�'


@pytest.mark.parametrize(
    ('step', 'why'),
    [
        (Step('', 'echo words; exit 3'), 'ended with exit code 3, not 0'),
        (Step('', 'echo words', code=2), 'ended with exit code 0, not 2'),
        (Step('', 'echo words', '^other$'), "has not printed '\\^other\\$'"),
        (Step('', 'echo words; sleep 60', limit_s=0.3), 'has not ended in time'),
        (Step('', 'echo words; sleep 60', 'other', limit_s=0.3, ctrl_c=True), 'in time'),
        (Step('', 'echo words', 'other', ctrl_c=True), 'ended with exit code 0 by itself'),
    ],
)  # fmt: skip
def test_a_promise_that_is_broken_ends_the_walk_and_names_the_command(shell, step, why):
    with pytest.raises(StepFailedError, match=why) as failed:
        walk(shell, step, Step('', 'touch reached'))
    assert str(failed.value).startswith(step.command)
    assert str(failed.value).endswith('words')
    assert not (shell.home / 'reached').exists()


GOES_ON = "trap 'echo ended; exit 5' INT; echo began; while :; do sleep 0.05; done"


def test_what_goes_on_is_ended_by_ctrl_c_after_the_steps_meanwhile(shell):
    step = Step('', GOES_ON, 'began', code=5, ctrl_c=True, meanwhile=(Step('', 'echo beside'),))
    (done,) = walk(shell, step)
    assert done.output == 'began\nended\n'
    assert [one.output for one in done.meanwhile] == ['beside\n']
    assert done.seconds >= done.meanwhile[0].seconds


def test_ctrl_c_arrives_though_the_walk_itself_ignores_it(shell):
    heeded = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        walk(shell, Step('', 'echo began; exec sleep 60', 'began', code=-2, ctrl_c=True))
    finally:
        signal.signal(signal.SIGINT, heeded)


def test_nothing_goes_on_when_a_walk_has_failed(shell):
    failing = Step('', 'exit 1')
    step = Step('', f'echo $$ > pid; {GOES_ON}', 'began', ctrl_c=True, meanwhile=(failing,))
    with pytest.raises(StepFailedError, match='exit 1'):
        walk(shell, step)
    pid = int((shell.home / 'pid').read_text())
    assert not Path(f'/proc/{pid}').exists()


def test_a_walk_has_no_virtual_environment_and_a_domain_of_its_own():
    mine = str(Path(sys.executable).parent)
    environ = environment(
        {'PATH': f'{mine}:/x/.venv/bin:/usr/bin', 'PYTHONPATH': 'p', 'LANG': 'C'}, 217
    )
    assert environ['PATH'] == '/usr/bin'
    assert environ['ROS_DOMAIN_ID'] == '217'
    assert environ['LANG'] == 'C'
    assert 'PYTHONPATH' not in environ


@pytest.mark.parametrize(
    ('text', 'cleaned'),
    [
        ('\x1b[32mgreen\x1b[0m', 'green'),
        ('0%\r50%\r100%', '100%'),
        ('line\r\n', 'line\n'),
        ('in /tmp/home_1/srnn/run', 'in ~/srnn/run'),
        ('in /opt/some/where/file.py', 'in …/file.py'),
        ('of box7, not of box72', 'of HOST, not of box72'),
        ('log/2026-box7-1', 'log/2026-HOST-1'),
        ('get https://there.example/simple/', 'get URL'),
        ('see http://127.0.0.1:8080/', 'see http://127.0.0.1:8080/'),
        ('topic /tracker/stop of left/weights', 'topic /tracker/stop of left/weights'),
    ],
)  # fmt: skip
def test_what_tells_of_the_machine_is_left_out(text, cleaned):
    assert CLEANER.clean(text) == cleaned


def test_a_short_output_is_shown_as_it_is():
    lines = [str(n) for n in range(HEAD + TAIL)]
    assert shortened('\n'.join(lines) + '\n', '') == lines
    assert shortened('', '') == []


def test_of_a_long_output_the_ends_and_what_was_promised_are_shown():
    lines = [f'line {n}' for n in range(40)]
    shown = shortened('\n'.join(lines), '^line 20$')
    assert shown == [*lines[:HEAD], '... 14 lines', 'line 20', '... 13 lines', *lines[-TAIL:]]
    one_more = [f'line {n}' for n in range(HEAD + TAIL + 1)]
    assert shortened('\n'.join(one_more), '') == one_more


def test_of_a_long_line_its_beginning_is_shown():
    (line,) = shortened('x' * (WIDTH + 1), '')
    assert line == 'x' * (WIDTH - 1) + '…'


def test_a_page_shows_all_commands_with_their_times():
    inner = Done(Step('Beside.', 'two'), 'said\n', 0, 1.0)
    outer = Step('First.', "one <<'END'\nmore\nEND", ctrl_c=True, meanwhile=(inner.step,))
    steps = (outer, Step('Last.', 'three', code=2))
    done = (Done(outer, '', 0, 75.4, (inner,)), Done(steps[1], '', 2, 0.25))
    one = Walk('w', 'a walk', 'this', steps)
    text = page([one], {'w': Walked(one, done, 80.0, 'Fact.')}, CLEANER, old='')
    assert commands(text) == ["one <<'END'\nmore\nEND", 'two', 'three']
    assert '| a walk | this | 3 | `one' in text
    assert '**1 min 20 s**' in text
    assert 'Ended by Ctrl-C, exit code 0, 1 min 15 s.' in text
    assert 'Exit code 2, 0.2 s.' in text


def test_a_walk_that_is_not_made_anew_stays_on_the_page():
    walks = [Walk(name, f'walk {name}', 'this', (Step('', name),)) for name in 'ab']
    first, then = (
        {one.name: Walked(one, (Done(one.steps[0], 'said\n', 0, s),), s, 'Fact.') for one in walks}
        for s in (1.0, 2.0)
    )
    both = page(walks, first, CLEANER, old='')
    assert page(walks, {}, CLEANER, both) == both
    newer = page(walks, {'b': then['b']}, CLEANER, both)
    assert re.findall(r'\*\*(.+)\*\*', newer) == ['1.0 s', '2.0 s']
    assert commands(newer) == ['a', 'b']


def typed_in(steps):
    for step in steps:
        yield step.command
        yield from typed_in(step.meanwhile)


def test_the_page_is_of_the_walks_that_there_are():
    text = PAGE.read_text(encoding='utf-8')
    assert commands(text) == [command for walk in WALKS for command in typed_in(walk.steps)]
    rows = dict(re.findall(r'^\| ([^|]+) \|.*\| \*\*(.+)\*\* \|$', text, re.MULTILINE))
    assert list(rows) == [walk.title for walk in WALKS]
    for total in rows.values():
        minutes, seconds = re.fullmatch(r'(\d+) min (\d+) s', total).groups()
        assert 60 * int(minutes) + int(seconds) <= LIMIT_S


def test_a_walk_begins_with_getting_the_repository():
    for one in WALKS:
        assert any(step.command.startswith('git clone REPOSITORY') for step in one.steps[:3])
