# SPDX-License-Identifier: Apache-2.0
import os
from pathlib import Path
import signal
import subprocess
import sys
import textwrap
import time

import pytest

from srnn_bringup.errors import BringupError, NodeDiedError
from srnn_bringup.supervisor import Command, Supervisor

PATIENCE_S = 20.0
QUICK = ((signal.SIGINT, 0.3), (signal.SIGTERM, 0.3), (signal.SIGKILL, 5.0))

OBEDIENT = """
    import signal, sys, time
    def leave(number, frame):
        print(f'{signal.Signals(number).name} {time.monotonic_ns()}', flush=True)
        sys.exit(0)
    signal.signal(signal.SIGINT, leave)
    sys.stdout.write('ready\\n')
    while True:
        time.sleep(0.01)
"""
DEAF = """
    import signal, sys, time
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, frame: print(signal.Signals(number).name, flush=True))
    sys.stdout.write('ready\\n')
    while True:
        time.sleep(0.01)
"""


def python(name: str, code: str) -> Command:
    environment = {**os.environ, 'PYTHONUNBUFFERED': '1'}
    return Command(name, (sys.executable, '-c', textwrap.dedent(code)), environment)


def wait_for(condition):
    end = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < end, 'waited in vain'
        time.sleep(0.01)


def exists(pid: int) -> bool:
    return Path(f'/proc/{pid}').exists()


@pytest.fixture
def supervisor(tmp_path):
    with Supervisor(tmp_path, QUICK) as supervisor:
        yield supervisor


def start(supervisor, **codes):
    for name, code in codes.items():
        supervisor.start(python(name, code))
    wait_for(lambda: all('ready' in supervisor.last_lines(name) for name in codes))


def test_each_line_is_new_once_and_only_when_it_is_whole(supervisor, tmp_path):
    start(supervisor, one=OBEDIENT)
    assert supervisor.new_lines('one') == ['ready']
    assert supervisor.new_lines('one') == []
    with (tmp_path / 'one.log').open('a') as log:
        for text, lines in (('first\n\nsec', ['first', '']), ('ond\n', ['second']), ('\n', [''])):
            print(text, end='', file=log, flush=True)
            assert supervisor.new_lines('one') == lines


def test_nothing_has_died_while_all_run(supervisor):
    start(supervisor, one=OBEDIENT, two=OBEDIENT)
    assert supervisor.deaths() == []
    assert supervisor.alive('one')


@pytest.mark.parametrize(
    ('code', 'words'),
    [
        ('raise SystemExit(3)', 'two ended with exit code 3'),
        ('pass', 'two ended with exit code 0'),
        ('import os; os.kill(os.getpid(), 9)', 'two was killed by SIGKILL'),
        ('import os; os.abort()', 'two was killed by SIGABRT'),
    ],
)
def test_the_first_death_is_named_with_its_cause(supervisor, code, words):
    start(supervisor, one=OBEDIENT)
    supervisor.start(python('two', code))
    wait_for(supervisor.deaths)
    (death,) = supervisor.deaths()
    assert (death.name, death.words()) == ('two', words)
    assert supervisor.alive('one')


def test_last_words_are_kept(supervisor):
    supervisor.start(python('one', "print(*range(100), sep='\\n'); raise ValueError('no arm')"))
    wait_for(supervisor.deaths)
    lines = supervisor.deaths()[0].last_lines
    assert lines[-1] == 'ValueError: no arm'
    assert len(lines) == 8


def test_last_started_is_stopped_first_and_gently(supervisor):
    start(supervisor, one=OBEDIENT, two=OBEDIENT, three=OBEDIENT)
    supervisor.stop()
    ends = {}
    for name in ('one', 'two', 'three'):
        word, when = supervisor.last_lines(name)[-1].split()
        assert word == 'SIGINT'
        ends[name] = int(when)
    assert sorted(ends, key=ends.get) == ['three', 'two', 'one']


def test_who_does_not_listen_is_killed(supervisor):
    start(supervisor, one=DEAF)
    pid = supervisor.pids['one']
    supervisor.stop()
    assert supervisor.last_lines('one') == ('ready', 'SIGINT', 'SIGTERM')
    assert supervisor.deaths()[0].words() == 'one was killed by SIGKILL'
    assert not exists(pid)


def test_even_a_stopped_process_does_not_stay(supervisor):
    start(supervisor, one=OBEDIENT)
    pid = supervisor.pids['one']
    os.kill(pid, signal.SIGSTOP)
    supervisor.stop()
    assert not exists(pid)


def test_nothing_is_left_after_an_error(tmp_path):
    with pytest.raises(RuntimeError), Supervisor(tmp_path, QUICK) as supervisor:  # noqa: PT012
        start(supervisor, one=OBEDIENT, two=DEAF)
        pids = list(supervisor.pids.values())
        raise RuntimeError
    assert not any(exists(pid) for pid in pids)


def test_stopping_twice_is_stopping_once(supervisor):
    start(supervisor, one=OBEDIENT)
    supervisor.stop()
    supervisor.stop()
    assert len(supervisor.last_lines('one')) == 2


def test_processes_do_not_get_the_signals_of_the_terminal(supervisor):
    start(supervisor, one=OBEDIENT)
    pid = supervisor.pids['one']
    assert os.getpgid(pid) == pid != os.getpgid(0)


def test_a_dead_process_can_be_started_anew(supervisor):
    start(supervisor, one=OBEDIENT, two=OBEDIENT)
    before = supervisor.pids
    os.kill(before['one'], signal.SIGKILL)
    wait_for(supervisor.deaths)
    supervisor.start(python('one', OBEDIENT))
    assert supervisor.deaths() == []
    assert list(supervisor.pids) == ['one', 'two']
    assert supervisor.pids['one'] != before['one']


def test_program_that_does_not_exist_is_named(supervisor):
    with pytest.raises(NodeDiedError, match='one cannot be started') as caught:
        supervisor.start(Command('one', ('/does/not/exist',), {}))
    assert isinstance(caught.value, BringupError)


def test_processes_end_with_an_owner_that_is_killed(tmp_path):
    owner = f"""
        import os, signal
        from pathlib import Path
        from srnn_bringup.supervisor import Command, Supervisor
        import sys, time
        supervisor = Supervisor(Path({str(tmp_path)!r}))
        supervisor.start(Command('one', (sys.executable, '-c', 'import time; time.sleep(60)'),
                                 os.environ))
        print(supervisor.pids['one'], flush=True)
        os.kill(os.getpid(), signal.SIGKILL)
    """
    done = subprocess.run(
        [sys.executable, '-c', textwrap.dedent(owner)],
        capture_output=True, text=True, timeout=PATIENCE_S, check=False,
    )  # fmt: skip
    assert done.returncode == -signal.SIGKILL, done.stderr
    wait_for(lambda: not running(int(done.stdout)))


def running(pid: int) -> bool:
    """Tell whether a process is alive; one that nobody waits for is not."""
    try:
        return ') Z ' not in Path(f'/proc/{pid}/stat').read_text()
    except OSError:
        return False
