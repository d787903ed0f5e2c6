# SPDX-License-Identifier: Apache-2.0
"""Others that want the processors."""

from collections.abc import Iterator
from contextlib import contextmanager
import subprocess
import sys


@contextmanager
def busy_loops(count: int) -> Iterator[None]:
    """Have so many processes do nothing as fast as they can, at the priority of this one."""
    loops = [subprocess.Popen([sys.executable, '-c', 'while True: pass']) for _ in range(count)]
    try:
        yield
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()
