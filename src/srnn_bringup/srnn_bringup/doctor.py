# SPDX-License-Identifier: Apache-2.0
"""`srnn doctor`: what is installed, what is missing, what rights the process has."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from importlib import import_module, metadata
import os
from pathlib import Path
import resource
import sys

from srnn_bringup.config import Choices, load
from srnn_bringup.config_lookup import config_directory, scene_names
from srnn_bringup.environment import (
    DISCOVERY_RANGE,
    DOMAIN_ID,
    FAST_DDS,
    MIDDLEWARE,
    uses_loopback,
)
from srnn_bringup.errors import BringupError
from srnn_config import ConfigError

PYTHON = (3, 11)
NEEDED = (
    'numpy', 'numba', 'mujoco', 'yaml', 'matplotlib', 'rclpy', 'lifecycle_msgs',
    'std_msgs', 'std_srvs', 'geometry_msgs', 'nav_msgs', 'sensor_msgs', 'trajectory_msgs',
    'visualization_msgs', 'diagnostic_msgs', 'cryptography', 'mcap', 'srnn_access', 'srnn_bag',
    'srnn_config', 'srnn_msgs_py', 'srnn_node', 'srnn_planner', 'lwr_description', 'lwr_guard',
    'lwr_tracking', 'lwr_sim_bridge', 'lwr_fri_driver', 'srnn_replay', 'viser', 'srnn_view',
)  # fmt: skip

RECEIVE_QUEUE = 1 << 20
"""Bytes that `config/fastdds.xml` asks for: some messages of weights fit into it."""

_RECEIVE_MAX = Path('/proc/sys/net/core/rmem_max')

_DISTRIBUTIONS = {'yaml': 'PyYAML'}


class Verdict(Enum):
    """How bad a finding is."""

    OK = 'ok'
    NOTE = 'note'
    MISSING = 'MISSING'


@dataclass(frozen=True)
class Finding:
    """One thing that was looked at.

    Attributes:
        subject: what was looked at.
        verdict: how bad it is.
        words: what was found, and what helps.

    """

    subject: str
    verdict: Verdict
    words: str


def run_doctor(say: Callable[[str], None]) -> int:
    """Say what was found; return 0 when nothing that is needed is missing, else 1."""
    worst = 0
    for finding in examine():
        say(f'{finding.verdict.value:>7}  {finding.subject:<22} {finding.words}')
        worst = max(worst, int(finding.verdict is Verdict.MISSING))
    return worst


def examine(environ: Mapping[str, str] = os.environ) -> Iterator[Finding]:
    """Yield everything worth looking at."""
    yield _python()
    for name in NEEDED:
        yield _package(name)
    yield _configuration()
    yield from _rights()
    yield from _middleware(environ)
    yield _security(environ)


def _python() -> Finding:
    found = '.'.join(map(str, sys.version_info[:3]))
    needed = '.'.join(map(str, PYTHON))
    verdict = Verdict.OK if sys.version_info >= PYTHON else Verdict.MISSING
    return Finding('python', verdict, f'{found} (needed: {needed} or newer), {sys.executable}')


def _package(name: str) -> Finding:
    try:
        import_module(name)
    except ImportError as error:
        return Finding(name, Verdict.MISSING, f'cannot be imported: {error}')
    try:
        return Finding(name, Verdict.OK, metadata.version(_DISTRIBUTIONS.get(name, name)))
    except metadata.PackageNotFoundError:
        return Finding(name, Verdict.OK, 'from the source tree')


def _configuration() -> Finding:
    try:
        directory = config_directory()
        load(Choices(), directory)
    except (BringupError, ConfigError) as error:
        return Finding('configuration', Verdict.MISSING, str(error))
    scenes = ', '.join(scene_names(directory))
    return Finding('configuration', Verdict.OK, f'{directory}; scenes: {scenes}')


def _rights() -> Iterator[Finding]:
    policy, parameters = os.sched_getscheduler(0), os.sched_getparam(0)
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))
        os.sched_setscheduler(0, policy, parameters)
        yield Finding('real-time priority', Verdict.OK, 'SCHED_FIFO is allowed')
    except OSError as error:
        words = f'{error.strerror}: the arm is controlled with more jitter'
        yield Finding('real-time priority', Verdict.NOTE, words)
    soft, _ = resource.getrlimit(resource.RLIMIT_MEMLOCK)
    unlimited = soft == resource.RLIM_INFINITY or os.geteuid() == 0
    words = 'unlimited' if unlimited else f'at most {soft // 1024} KiB'
    yield Finding('locked memory', Verdict.OK if unlimited else Verdict.NOTE, words)


def _middleware(environ: Mapping[str, str]) -> Iterator[Finding]:
    if uses_loopback(environ):
        yield Finding('discovery', Verdict.OK, 'this host only, over the loopback interface')
    else:
        wide = environ.get(DISCOVERY_RANGE) or 'LOCALHOST'
        local = wide in ('LOCALHOST', 'OFF')
        words = f'{DISCOVERY_RANGE} = {wide}, with transports of your choice'
        risk = '' if local else ': other hosts can take part, and command the arm'
        yield Finding('discovery', Verdict.OK if local else Verdict.NOTE, words + risk)
    yield _receive_queue(int(_RECEIVE_MAX.read_text()))
    yield Finding(DOMAIN_ID, Verdict.OK, environ.get(DOMAIN_ID) or '0, unless set')
    middleware = environ.get(MIDDLEWARE) or FAST_DDS
    tested = middleware == FAST_DDS
    words = middleware if tested else f'{middleware}: only {FAST_DDS} is tested'
    yield Finding(MIDDLEWARE, Verdict.OK if tested else Verdict.NOTE, words)


def _receive_queue(allowed: int) -> Finding:
    if allowed >= RECEIVE_QUEUE:
        return Finding('receive queue', Verdict.OK, f'{RECEIVE_QUEUE} bytes are allowed')
    words = (
        f'{allowed} bytes, {RECEIVE_QUEUE} wanted: recordings may have gaps; '
        f'sudo sysctl -w net.core.rmem_max={RECEIVE_QUEUE}'
    )
    return Finding('receive queue', Verdict.NOTE, words)


def _security(environ: Mapping[str, str]) -> Finding:
    try:
        from srnn_bringup.security import lack_of_security

        lack = lack_of_security(environ)
    except (BringupError, ImportError) as error:
        lack = str(error)
    if lack:
        words = f'not available ({lack}): use a key, srnn up --key FILE'
        return Finding('DDS security', Verdict.NOTE, words)
    return Finding('DDS security', Verdict.OK, 'available: srnn up --secure KEYSTORE')
