# SPDX-License-Identifier: Apache-2.0
"""A running `srnn` command: what it prints, and the processes below it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import os
from pathlib import Path
import re
import subprocess
import sys
import threading
import time

START_S = 120.0
"""The first start on a machine compiles the kernels."""

RUN_S = 90.0
STOP_S = 30.0

SCENE = """
name: wall
waypoints: [[-0.03, 0.0], [0.15, -0.15]]
blocked: 1
obstacles:
  - {shape: box, center: [0.05, -0.06], size: [0.04, 0.12], yaw: 0.7}
"""


class Srnn:
    """A process, its lines, and the nodes that it has started, by module."""

    def __init__(self, folder: Path, *arguments: str) -> None:
        self.lines: list[str] = []
        self.process = subprocess.Popen(
            [sys.executable, '-m', 'srnn_bringup.cli', *arguments],
            cwd=folder,
            env={**os.environ, 'TMPDIR': str(folder)},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self.pids: dict[str, int] = {}
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    @property
    def text(self) -> str:
        return '\n'.join(self.lines)

    def wait_for(self, words: str, seconds: float = START_S) -> None:
        end = time.monotonic() + seconds
        while words not in self.text:
            assert self.process.poll() is None, self.text
            assert time.monotonic() < end, self.text
            time.sleep(0.05)
        self.pids = self._children()

    def wait(self, seconds: float) -> int:
        code = self.process.wait(seconds)
        self._reader.join(seconds)
        return code

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.terminate()
        try:
            self.wait(STOP_S)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.wait(STOP_S)

    def _read(self) -> None:
        for line in self.process.stdout:
            self.lines.append(line.rstrip())

    def _children(self) -> dict[str, int]:
        listing = Path(f'/proc/{self.process.pid}/task/{self.process.pid}/children').read_text()
        children = {}
        for pid in map(int, listing.split()):
            command = Path(f'/proc/{pid}/cmdline').read_text()
            children.update(dict.fromkeys(re.findall(r'\w+_node\b', command), pid))
        return children


def nothing_left(srnn: Srnn, folder: Path) -> bool:
    """Tell whether all processes and the private files of a command are gone."""
    processes = [pid for pid in srnn.pids.values() if Path(f'/proc/{pid}').exists()]
    return not processes and not list(folder.glob('srnn_*'))


@contextmanager
def commands_in(folder: Path) -> Iterator[Callable[..., Srnn]]:
    """Start commands in a folder with the scene of the wall; nothing may be left of them."""
    running: list[Srnn] = []
    (folder / 'wall.yaml').write_text(SCENE)

    def run(*arguments: str) -> Srnn:
        running.append(Srnn(folder, *arguments))
        return running[-1]

    yield run
    for srnn in running:
        srnn.close()
    assert all(nothing_left(srnn, folder) for srnn in running)
