# SPDX-License-Identifier: Apache-2.0
"""Has one process say something to another, over the middleware of the graph."""

from collections.abc import Mapping
from dataclasses import dataclass
import json
import os
import subprocess
import sys

from srnn_bringup.environment import graph_environment

PROBE = 'srnn_bringup.doctor.messages_probe'

ARRIVE_S = 15.0
"""A message that has not arrived by then does not arrive [s]."""

START_S = 45.0
"""Longest wait for a process to start on a busy machine [s]."""


@dataclass(frozen=True)
class Heard:
    """What one process has heard of another.

    Attributes:
        failure: why nothing was heard; empty if something was.
        seconds: time from taking part to the first message [s].
        middleware: what it came over.
        others: names of nodes that were seen and are not ours.

    """

    failure: str = ''
    seconds: float = 0.0
    middleware: str = ''
    others: tuple[str, ...] = ()


def exchange(environ: Mapping[str, str]) -> Heard:
    """Have a process speak and another one listen, in the domain of the user.

    Args:
        environ: environment of the user; it has been checked.

    """
    environment = graph_environment(environ)
    topic = f'srnn_doctor_{os.getpid()}'

    def start(role: str) -> 'subprocess.Popen[str]':
        return subprocess.Popen(
            [sys.executable, '-m', PROBE, role, topic], env=environment, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )  # fmt: skip

    with start('speak') as speaker, start('listen') as listener:
        try:
            out, error = listener.communicate(timeout=START_S + ARRIVE_S)
        except subprocess.TimeoutExpired:
            return Heard(f'the middleware does not start within {START_S:g} s')
        finally:
            for process in (speaker, listener):
                if process.poll() is None:
                    process.kill()
    if listener.returncode != 0:
        lines = error.strip().splitlines() or [f'exit code {listener.returncode}']
        return Heard(f'the middleware does not start: {lines[-1]}')
    found = json.loads(out.splitlines()[-1])
    others = tuple(found['others'])
    if found['seconds'] is None:
        return Heard(f'none of another process arrives within {ARRIVE_S:g} s', others=others)
    return Heard('', found['seconds'], found['middleware'], others)
