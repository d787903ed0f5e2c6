# SPDX-License-Identifier: Apache-2.0
"""What the exit code of every command means."""

import signal

DONE = 0
"""All that was asked for was done; `srnn up` and `srnn record` were ended by their user."""

FAILED = 1
"""It was tried and failed, or what was compared or examined is not as it should be."""

WRONG_USE = 2
"""The command line or a file is wrong, and nothing was started."""

MEANINGS = """\
exit codes: 0 done; 1 failed, or found wanting; 2 wrong command line or file, nothing started;
128 + n ended by signal n (130: Ctrl-C).
"""


def by_signal(name: str) -> int:
    """Return the exit code of what a signal has ended before it was done.

    Args:
        name: name of the signal, as SIGINT.

    """
    return 128 + signal.Signals[name]
