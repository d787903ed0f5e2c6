# SPDX-License-Identifier: Apache-2.0
"""A process on one of two hosts, and what it prints; for fault tests."""

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
import json
import os
from pathlib import Path
import signal
import subprocess
import sys
import threading
import time
from types import TracebackType
from typing import Any, Self

from two_hosts import Host

STOP_S = 30.0
TAP = Path(__file__).parent / 'wire_tap.py'


class HostProcess:
    """A process whose output is read as it comes; as a context manager it ends with the block."""

    def __init__(
        self, host: Host, arguments: Sequence[str], environment: Mapping[str, str]
    ) -> None:
        """Start `arguments` with the environment of this process and some more."""
        self.lines: list[str] = []
        self.process = host.start(
            arguments, env={**os.environ, **environment},
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.end()

    @property
    def text(self) -> str:
        return '\n'.join(self.lines)

    def wait_for(self, words: str, seconds: float) -> None:
        self.until(lambda: words in self.text, seconds)

    def until(self, condition: Callable[[], object], seconds: float) -> None:
        """Wait for a condition on the output; the process must live."""
        end = time.monotonic() + seconds
        while not condition():
            assert self.process.poll() is None, self.text[-3000:]
            assert time.monotonic() < end, f'waited in vain; {self.text[-3000:]}'
            time.sleep(0.02)

    def child(self, words: str) -> int:
        """Return the id of the child with `words` in its command line."""
        pid = self.process.pid
        children = Path(f'/proc/{pid}/task/{pid}/children').read_text().split()
        (found,) = (c for c in children if words in Path(f'/proc/{c}/cmdline').read_text())
        return int(found)

    def wait(self, seconds: float) -> int:
        """Wait until the process has ended by itself; return its exit code."""
        code = self.process.wait(seconds)
        self._reader.join(seconds)
        return code

    def end(self, number: signal.Signals = signal.SIGINT) -> int:
        """End the process, by force if it takes too long; return its exit code."""
        if self.process.poll() is None:
            self.process.send_signal(number)
        try:
            self.process.wait(STOP_S)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait(STOP_S)
        return self.wait(STOP_S)

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.take(line.rstrip())

    def take(self, line: str) -> None:
        """Take in a line of the output."""
        self.lines.append(line)


class Tap(HostProcess):
    """What is heard of the graph on a host, as `wire_tap.py` tells it."""

    def __init__(self, host: Host, environment: Mapping[str, str]) -> None:
        """Begin to listen."""
        # Sorted as it comes: a tap that has run for long must not answer more slowly.
        self._heard: defaultdict[str, list[dict[str, Any]]] = defaultdict(list)
        super().__init__(host, [sys.executable, str(TAP)], environment)

    def heard(self, topic: str) -> list[dict[str, Any]]:
        """Return the messages of a topic so far, oldest first."""
        return self._heard[topic].copy()

    def take(self, line: str) -> None:
        super().take(line)
        if line.startswith('{'):
            message = json.loads(line)
            self._heard[message['topic']].append(message)

    def nodes(self) -> list[str]:
        """Return the names of the nodes that are seen now."""
        changes = self.heard('')
        return changes[-1]['nodes'] if changes else []
