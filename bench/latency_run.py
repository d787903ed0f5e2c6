# SPDX-License-Identifier: Apache-2.0
"""One recorded run of `srnn demo`, and what its bag tells of the time that things took."""

from collections.abc import Mapping
from dataclasses import dataclass
import os
from pathlib import Path
import subprocess
import sys
import time

import numpy as np
from numpy.typing import NDArray

from srnn_bag import Bag, open_bag
from srnn_bringup.latency import answers, lessons
from srnn_bringup.latency.planning_share import planning_shares
from srnn_bringup.page.bag_run import read_run
from srnn_bringup.page.timings import timings
from srnn_replay import planner_replay, tracker_replay
from srnn_replay.recording import Recording, prefixes

SHARE = 'planning, as a share of its segment'
ALL_ACTIVE = 'from the command line to all nodes active'
FIRST_COMMAND = 'from the command line to the first joint command'
FIRST_SEGMENT = 'from the command line to the first segment'

HEADING = 'segment  way point'
"""What `srnn demo` prints once all nodes are active."""

END_S = 60.0
"""Longest wait for the end of a command that has nothing more to say [s]; it bounds its own."""

Figures = Mapping[str, NDArray[np.float64]]


class RunFailedError(Exception):
    """A run did not come to its end."""


@dataclass(frozen=True)
class Measured:
    """One run.

    Attributes:
        figures: samples (n,) by what they are of: [ms], but `SHARE`.
        joint_states: joint states that were answered, or should have been.
        unanswered: how many of them were not.

    """

    figures: Figures
    joint_states: int
    unanswered: int


def run(
    folder: Path, segments: int, seed: int, environ: Mapping[str, str] = os.environ
) -> Measured:
    """Have the demo run in real time with a recorder, as a user does.

    Args:
        folder: empty directory for what it writes.
        segments: how many it executes.
        seed: seed of all its random numbers.
        environ: its environment.

    Raises:
        RunFailedError: it ended with an error; the message has its last words.

    """
    command = [
        sys.executable, '-m', 'srnn_bringup.cli', 'demo', '--segments', str(segments),
        '--seed', str(seed), '--record', 'bag', '--picture', 'run.png',
    ]  # fmt: skip
    began_ns, active_ns, lines = time.time_ns(), 0, []
    with subprocess.Popen(
        command, cwd=folder, env=environ, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True,
    ) as process:  # fmt: skip
        try:
            assert process.stdout is not None
            for line in process.stdout:
                active_ns = active_ns or (time.time_ns() if line.startswith(HEADING) else 0)
                lines.append(line.rstrip())
            code = process.wait(END_S)
        except BaseException:
            process.terminate()
            raise
    if code:
        raise RunFailedError(f'seed {seed}: exit code {code}: {"; ".join(lines[-3:])}')
    return _measured(folder / 'bag', began_ns, active_ns)


def _measured(directory: Path, began_ns: int, active_ns: int) -> Measured:
    bag = open_bag(directory)
    prefix = prefixes(bag)[0]
    tracker = Recording(bag, tracker_replay.NODE, answers.TOPICS, prefix)
    planner = Recording(bag, planner_replay.NODE, lessons.TOPICS, prefix)
    found = answers.answers(tracker)
    figures = {
        **timings(read_run(directory)),
        SHARE: planning_shares(planner),
        ALL_ACTIVE: 1e-6 * np.array([active_ns - began_ns], dtype=np.float64),
        FIRST_COMMAND: _first_ms(bag, f'{prefix}{answers.COMMANDS}', began_ns),
        FIRST_SEGMENT: _first_ms(bag, f'{prefix}segment', began_ns),
    }
    return Measured(figures, len(found.times_ms) + found.unanswered, found.unanswered)


def _first_ms(bag: Bag, topic: str, began_ns: int) -> NDArray[np.float64]:
    sent = [message.sent_ns for message in bag.messages({topic})]
    return 1e-6 * np.array([min(sent) - began_ns], dtype=np.float64)
