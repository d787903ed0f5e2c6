# SPDX-License-Identifier: Apache-2.0
"""What the documentation has its readers type in works, in the order of the page."""

from contextlib import suppress
import os
from pathlib import Path
import re
import signal
import socket
import subprocess
import sys
import time

from documented import (
    NOT_RUN,
    PAGES,
    ROOT,
    SLOW,
    UNTIL_CTRL_C,
    blocks,
    inline_code,
    shortened,
)
import pytest
import yaml

from srnn_bringup.cli import main
from srnn_bringup.config_files import FILES
from srnn_node.parameters import leaves

LIMIT_S = 400.0
STARTED_S = 120.0
RUNS_S = 3.0
"""How long what goes on until Ctrl-C is left running after the last command of its block."""

STARTED = re.compile(r'Ctrl-C')


def runnable(page):
    """Return the blocks of a page that are a file, a script, or a command that can be run."""
    return [block for block in blocks(page) if block.name or block.script or block.runnable]


def case(page):
    commands = [command for block in runnable(page) for command in block.runnable]
    marks = [pytest.mark.slow] if any(SLOW.search(command) for command in commands) else []
    return pytest.param(page, id=str(page.relative_to(ROOT)), marks=marks)


class Reader:
    """Does what a page says, in a folder that looks like the root of the workspace."""

    def __init__(self, folder):
        self.folder = folder
        self.going_on = []
        for name in ('config', 'examples', 'bench', 'src', 'docs', 'test', 'pyproject.toml'):
            (folder / name).symlink_to(ROOT / name)
        (folder / '.venv' / 'bin').mkdir(parents=True)
        for name in ('srnn', 'python'):
            (folder / '.venv' / 'bin' / name).symlink_to(Path(sys.executable).parent / name)
        path = f'{Path(sys.executable).parent}{os.pathsep}{os.environ["PATH"]}'
        self.environment = {**os.environ, 'PATH': path, 'PYTHONUNBUFFERED': '1'}
        with socket.socket() as probe:
            probe.bind(('127.0.0.1', 0))
            self.port = probe.getsockname()[1]

    def block(self, block):
        if block.name:
            (self.folder / block.name).write_text(block.text)
        elif block.script:
            self.run([sys.executable, '-c', block.text])
        for command in block.runnable:
            if UNTIL_CTRL_C.match(command):
                self.begin(shortened(command, self.port))
            else:
                self.run(['bash', '-ec', shortened(command, self.port)])
        if self.going_on:
            time.sleep(RUNS_S)
        while self.going_on:
            self.end(*self.going_on.pop())

    def run(self, words):
        done = subprocess.run(
            words, cwd=self.folder, env=self.environment, timeout=LIMIT_S,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip
        assert done.returncode == 0, f'{words[-1]}: {done.returncode}\n{done.stdout}'

    def begin(self, command):
        log = self.folder / f'{len(self.going_on)}.log'
        with log.open('w') as output:
            process = subprocess.Popen(
                ['bash', '-c', f'exec {command}'], cwd=self.folder, env=self.environment,
                stdout=output, stderr=subprocess.STDOUT, start_new_session=True,
            )  # fmt: skip
        self.going_on.append((command, process, log))
        end = time.monotonic() + STARTED_S
        while not STARTED.search(log.read_text()):
            assert process.poll() is None, f'{command}\n{log.read_text()}'
            assert time.monotonic() < end, f'{command}\n{log.read_text()}'
            time.sleep(0.1)

    def end(self, command, process, log):
        process.send_signal(signal.SIGINT)
        assert process.wait(STARTED_S) == 0, f'{command}\n{log.read_text()}'

    def close(self):
        for _, process, _ in self.going_on:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGTERM)
            process.wait(STARTED_S)


@pytest.fixture
def reader(tmp_path):
    reader = Reader(tmp_path)
    yield reader
    reader.close()


@pytest.mark.parametrize('page', [case(page) for page in PAGES if runnable(page)])
def test_a_reader_can_do_what_the_page_says(reader, page):
    for block in runnable(page):
        reader.block(block)


def test_what_is_not_run_is_named_with_its_reason_and_no_reason_is_idle():
    everything = [c for page in PAGES for block in blocks(page) for c in block.commands]
    for begin, why in NOT_RUN.items():
        assert why
        assert any(re.match(begin, command) for command in everything), begin


def test_every_target_of_make_that_is_named_exists():
    targets = set(re.findall(r'^([\w-]+):', (ROOT / 'Makefile').read_text(), re.MULTILINE))
    named = {
        target
        for page in PAGES
        for target in re.findall(r'(?:^|`)make ([\w-]+)', page.read_text(), re.MULTILINE)
    }
    assert {'setup', 'demo', 'test'} <= named <= targets


def test_most_of_what_is_documented_is_run():
    everything = [reason for page in PAGES for block in blocks(page) for reason in block.reasons]
    assert everything.count('') > len(everything) / 2


def test_the_readme_leads_to_every_page():
    readme = (ROOT / 'README.md').read_text(encoding='utf-8')
    for page in PAGES[1:]:
        if page.parent.name != 'decisions':
            assert f']({page.relative_to(ROOT)}' in readme, page


def test_parameters_that_pages_name_exist():
    names = [leaf.name for cls in FILES.values() for leaf in leaves(cls)]
    sets = {part for name in names for part in name.split('.')[:-1]} - {'arm', 'fri'}
    checked = 0
    for page, code in inline_code():
        key = re.fullmatch(r'(\w+)\.((?:\w+\.)*\w+)(?:: \S+)?', code)
        if key is None or key[1] not in sets or key[2] in ('py', 'md', 'yaml'):
            continue
        modules = ROOT.glob(f'src/*/*/**/{key[1]}.py')
        assert any(f'.{key[1]}.{key[2]}.' in f'.{name}.' for name in names) or any(
            f'def {key[2]}(' in module.read_text() for module in modules
        ), f'{page}: {code}'
        checked += 1
    assert checked > 10


def test_options_that_pages_name_within_a_sentence_exist(capsys):
    checked = 0
    for page, code in inline_code():
        words = code.split()
        if words[0] != 'srnn' or len(words) < 2 or not re.fullmatch('[a-z0-9]+', words[1]):
            continue
        action = words[2:3] if words[1] in ('experiment', 'belief', 'key', 'keystore') else []
        with pytest.raises(SystemExit) as end:
            main([words[1], *(a for a in action if '|' not in a), '--help'])
        text = capsys.readouterr().out
        assert end.value.code == 0, f'{page.name}: {code}'
        for option in re.findall(r'--[\w-]+', code):
            assert option in text, f'{page.name}: {code}'
        checked += 1
    assert checked > 20


def test_the_citation_is_of_this_version():
    citation = yaml.safe_load((ROOT / 'CITATION.cff').read_text())
    setup = (ROOT / 'src' / 'srnn_planner' / 'setup.py').read_text()
    assert f"version='{citation['version']}'" in setup
    assert citation['preferred-citation']['doi'] == '10.1016/j.neunet.2018.10.005'
