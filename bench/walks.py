# SPDX-License-Identifier: Apache-2.0
"""Walks up to the project as a stranger: with a laptop, with ROS 2, with another arm.

Run: .venv/bin/python bench/walks.py [--only WALK,...] [--ros-setup FILE] [--out FILE]

What is committed is cloned. A page that is there keeps the walks that are not made anew. The exit
code is 1 if a command does not do what it has to, or if a walk takes more than ten minutes.
"""

import argparse
from collections.abc import Mapping, Sequence
import getpass
import os
from pathlib import Path
import platform
import shlex
import shutil
import socket
import subprocess
import sys
import tempfile
import time

from walk import ROS_SETUP, SOURCE, Shell, StepFailedError, Walk
from walk_page import Walked, page
from walk_steps import ROOT, ROS2, WALKS
from walk_transcript import Cleaner, duration

from srnn_bench.machine import processor

UBUNTU_SETUP = Path('/opt/ros/jazzy/setup.bash')
LIMIT_S = 600.0
FIRST_DOMAIN = 215
"""Each walk has a domain; up to 232 no port of DDS is one that Linux gives to anybody."""

KEPT = ('LANG', 'LC_', 'TERM', 'PIP_', 'SSL_', 'http', 'https', 'no_proxy')
"""Beginnings of variables that a walk inherits, besides a `PATH` without virtual environments."""


def environment(environ: Mapping[str, str], domain: int) -> dict[str, str]:
    """Return the environment of a shell that has just been opened."""
    kept = {name: value for name, value in environ.items() if name.startswith(KEPT)}
    mine = str(Path(sys.executable).parent)
    path = [p for p in environ['PATH'].split(os.pathsep) if p != mine and '.venv' not in p]
    settings = Path.home() / '.config' / 'pip' / 'pip.conf'
    if settings.exists():
        # Where packages come from is a matter of the machine.
        kept.setdefault('PIP_CONFIG_FILE', str(settings))
    return {
        **kept, 'PATH': os.pathsep.join(path), 'ROS_DOMAIN_ID': str(domain),
        'PYTHONUNBUFFERED': '1',
    }  # fmt: skip


def walked(walk: Walk, environ: Mapping[str, str], ros: Path, names: dict[str, str]) -> Walked:
    """Make a walk, and add to `names` what stands for its home on the page.

    Raises:
        StepFailedError: a command did not do what it has to.

    """
    home = Path(tempfile.mkdtemp(prefix=f'walk_{walk.name}_'))
    names[str(home)] = '~'
    facts = f'{machine()}; {ros_versions(environ, ros) if walk is ROS2 else versions(environ)}.'
    began = time.monotonic()

    def say(command: str) -> None:
        print(f'{walk.name} {duration(time.monotonic() - began)}: {command}', file=sys.stderr)

    shell = Shell(home, environ, {SOURCE: str(ROOT), ROS_SETUP: str(ros)}, say)
    try:
        done = tuple(shell.walk(walk.steps))
        return Walked(walk, done, time.monotonic() - began, facts)
    finally:
        if walk.farewell:
            shell.call(walk.farewell)
        shutil.rmtree(home, ignore_errors=True)


def machine() -> str:
    """Return on what a walk is made, how busy it is, and with which priority."""
    group = Path('/proc/self/autogroup')
    nice = group.read_text().split()[-1] if group.exists() else '0'
    return (
        f'{processor()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f} before the walk'
        + (f', with the priority nice {nice} among other work' if nice != '0' else '')
        + f', {platform.freedesktop_os_release()["PRETTY_NAME"]}'
    )


def versions(environ: Mapping[str, str], before: str = ':') -> str:
    """Return which Python a shell has, after a command."""
    words = f'{before} && python3 --version && git --version'
    done = subprocess.run(
        ['bash', '-c', words], env=environ, capture_output=True, text=True, check=True
    )
    return ', '.join(done.stdout.split('\n')[:2])


def ros_versions(environ: Mapping[str, str], ros: Path) -> str:
    """Return which Python a shell with ROS 2 has, and where its ROS 2 is from."""
    python = versions(environ, f'. {shlex.quote(str(ros))}')
    if ros == UBUNTU_SETUP and platform.freedesktop_os_release()['ID'] == 'ubuntu':
        return f'{python}, the packages of ROS 2 Jazzy for Ubuntu'
    return (
        f'{python}. **Not Ubuntu 24.04**: `ROS_SETUP` brings the ROS 2 Jazzy of the wheels in '
        '`requirements.lock` into a shell, with colcon, ros2cli and launch beside it '
        f'([how](ros2.md#how-this-was-checked)); on Ubuntu it is `{UBUNTU_SETUP}`, and the '
        'dependencies are those that `rosdep install` brings'
    )


def names_of_the_machine(ros: Path) -> dict[str, str]:
    """Return what must not be on a page, and what stands for it."""
    names = {str(ROOT): SOURCE, str(ros): ROS_SETUP, socket.gethostname(): 'HOST'}
    user = getpass.getuser()
    return names if user == 'root' else {**names, user: 'USER'}


def main(words: Sequence[str] | None = None) -> int:
    """Make the walks, and print or write the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    every = ','.join(walk.name for walk in WALKS)
    parser.add_argument('--only', default=every, metavar='WALK,...', help='default: %(default)s')
    parser.add_argument(
        '--ros-setup', type=Path, default=UBUNTU_SETUP, metavar='FILE',
        help='what brings ROS 2 into a shell, default: %(default)s',
    )  # fmt: skip
    parser.add_argument('--out', type=Path, metavar='FILE', help='where the page is written')
    choice = parser.parse_args(words)
    chosen = choice.only.split(',')
    if unknown := set(chosen) - {walk.name for walk in WALKS}:
        parser.error(f'--only: {", ".join(sorted(unknown))}: must be of {every}')
    names = names_of_the_machine(choice.ros_setup)
    made: dict[str, Walked] = {}
    failures: list[str] = []
    for domain, walk in enumerate(WALKS, start=FIRST_DOMAIN):
        if walk.name in chosen:
            environ = environment(os.environ, domain)
            try:
                made[walk.name] = walked(walk, environ, choice.ros_setup, names)
            except StepFailedError as error:
                failures.append(f'walk {walk.name}: {error}')
    failures += [
        f'walk {name}: {duration(one.seconds)}, more than {duration(LIMIT_S)}'
        for name, one in made.items() if one.seconds > LIMIT_S
    ]  # fmt: skip
    roots = frozenset(folder.name for folder in Path('/').iterdir())
    old = choice.out.read_text(encoding='utf-8') if choice.out and choice.out.exists() else ''
    text = page(WALKS, made, Cleaner(names, roots), old)
    print(text, end='')
    if choice.out:
        choice.out.write_text(text, encoding='utf-8')
    for failure in failures:
        print(failure, file=sys.stderr)
    return 1 if failures else 0


if __name__ == '__main__':
    raise SystemExit(main())
