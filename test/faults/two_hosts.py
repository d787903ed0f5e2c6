# SPDX-License-Identifier: Apache-2.0
"""Two hosts on one machine: network namespaces with a link between them, for fault tests."""

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
import os
from pathlib import Path
import shutil
import signal
import subprocess
from typing import Any

TOOLS = ('ip', 'unshare', 'nsenter', 'mount')
STEP_S = 10.0
"""Longest time that one step of the set-up may take [s]."""

INTERFACE = 'eth0'
NAMES = ('arm', 'brain')
ADDRESSES = (('10.77.0.1', 'fd77::1'), ('10.77.0.2', 'fd77::2'))
"""IPv4 and IPv6 address of each host."""


class Host:
    """A network, shared memory and host table of its own.

    Attributes:
        name: what the hosts call it.
        ipv4: its address on the link.
        ipv6: the same for IPv6.

    """

    def __init__(self, name: str, ipv4: str, ipv6: str, pid: int) -> None:
        """Take the namespaces of the process `pid`."""
        self.name = name
        self.ipv4 = ipv4
        self.ipv6 = ipv6
        self.pid = pid

    def command(self, arguments: Sequence[str]) -> list[str]:
        """Return the command line that runs `arguments` on this host, in the same process."""
        where = f'--wdns={os.getcwd()}'
        return ['nsenter', '-t', str(self.pid), '-n', '-m', where, '--', *arguments]

    def start(self, arguments: Sequence[str], **options: Any) -> 'subprocess.Popen[str]':
        """Start a process on this host; its id is that of the program itself."""
        return subprocess.Popen(self.command(arguments), text=True, **options)

    def sent(self) -> tuple[int, int]:
        """Return how many packets and bytes have left this host."""
        done = _do(self.command(['cat', '/proc/net/dev']))
        (row,) = (line for line in done.splitlines() if line.strip().startswith(INTERFACE))
        columns = row.partition(':')[2].split()
        return int(columns[9]), int(columns[8])

    def ip(self, *arguments: str) -> None:
        """Run `ip` on this host."""
        _do(self.command(['ip', *arguments]))


@dataclass(frozen=True)
class TwoHosts:
    """Two hosts and the cable between them.

    Attributes:
        arm: the first host.
        brain: the second one.

    """

    arm: Host
    brain: Host

    def cut(self) -> None:
        """Pull the cable."""
        self.brain.ip('link', 'set', INTERFACE, 'down')

    def mend(self) -> None:
        """Plug it in again."""
        self.brain.ip('link', 'set', INTERFACE, 'up')
        # An interface that was down has forgotten its IPv6 address.
        self.brain.ip('-6', 'addr', 'replace', f'{self.brain.ipv6}/64', 'dev', INTERFACE, 'nodad')


def why_not() -> str:
    """Return why there can be no two hosts on this machine, empty if there can."""
    missing = [tool for tool in TOOLS if shutil.which(tool) is None]
    if missing:
        return f'not installed: {", ".join(missing)}'
    done = subprocess.run(
        ['unshare', '-n', '-m', 'true'], capture_output=True, text=True, timeout=STEP_S
    )
    return done.stderr.strip()


@contextmanager
def two_hosts(directory: Path) -> Iterator[TwoHosts]:
    """Make two hosts with a link between them; they vanish with the processes that hold them.

    Args:
        directory: existing directory for their table of host names.

    """
    table = directory / 'hosts'
    rows = [f'{v4} {name}' for name, (v4, _) in zip(NAMES, ADDRESSES, strict=True)]
    table.write_text('\n'.join(['127.0.0.1 localhost', *rows, '']))
    with ExitStack() as stack:
        arm, brain = (
            Host(name, *addresses, stack.enter_context(_holder(table)))
            for name, addresses in zip(NAMES, ADDRESSES, strict=True)
        )
        other_end = ('peer', INTERFACE, 'netns', str(brain.pid))
        arm.ip('link', 'add', INTERFACE, 'type', 'veth', *other_end)
        for host in (arm, brain):
            host.ip('link', 'set', 'lo', 'up')
            host.ip('addr', 'add', f'{host.ipv4}/24', 'dev', INTERFACE)
            host.ip('addr', 'add', f'{host.ipv6}/64', 'dev', INTERFACE, 'nodad')
            host.ip('link', 'set', INTERFACE, 'up')
        yield TwoHosts(arm, brain)


@contextmanager
def _holder(table: Path) -> Iterator[int]:
    """Hold fresh namespaces; yield the id of the process that does."""
    # Without shared memory of its own, Fast DDS would talk through the border.
    script = (
        'mount -t tmpfs shm /dev/shm && mount --bind "$0" /etc/hosts && echo ready && '
        'exec sleep 1000000'
    )
    process = subprocess.Popen(
        ['unshare', '-n', '-m', 'sh', '-c', script, str(table)],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    try:
        assert process.stdout is not None
        line = process.stdout.readline()
        assert line == 'ready\n', line
        yield process.pid
    finally:
        process.send_signal(signal.SIGKILL)
        process.wait(STEP_S)
        process.stdout.close()


def _do(command: Sequence[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True, timeout=STEP_S)
    assert done.returncode == 0, f'{" ".join(command)}: {done.stderr}'
    return done.stdout
