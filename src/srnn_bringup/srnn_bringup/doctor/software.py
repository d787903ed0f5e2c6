# SPDX-License-Identifier: Apache-2.0
"""What is installed: packages, their versions, the configuration."""

from collections.abc import Iterator, Mapping
from importlib import metadata
from pathlib import Path
import sys

from srnn_bringup.config_lookup import config_directory, scene_names
from srnn_bringup.doctor.defaults import SUBJECT, defaults
from srnn_bringup.doctor.finding import Finding, Verdict, judged
from srnn_bringup.doctor.imports import refusals

PYTHON = (3, 11)
NEEDED = (
    'numpy', 'numba', 'mujoco', 'yaml', 'matplotlib', 'rclpy', 'lifecycle_msgs',
    'std_msgs', 'std_srvs', 'geometry_msgs', 'nav_msgs', 'sensor_msgs', 'trajectory_msgs',
    'visualization_msgs', 'diagnostic_msgs', 'cryptography', 'mcap', 'srnn_access', 'srnn_bag',
    'srnn_config', 'srnn_msgs_py', 'srnn_node', 'srnn_planner', 'lwr_description', 'lwr_guard',
    'lwr_tracking', 'lwr_sim_bridge', 'lwr_fri_driver', 'srnn_replay', 'viser', 'srnn_view',
)  # fmt: skip

SETUP = 'run make setup in the source tree, or rosdep install and colcon build'

LISTED = 4
"""So many packages with other versions are named."""

_DISTRIBUTIONS = {'yaml': 'PyYAML'}


def software(environ: Mapping[str, str]) -> Iterator[Finding]:
    """Yield what is installed."""
    yield _python()
    reasons = refusals(NEEDED, environ)
    for name in NEEDED:
        yield _package(name, reasons.get(name, ''))
    yield versions(lock_file())
    yield _configuration()


def _python() -> Finding:
    found = '.'.join(map(str, sys.version_info[:3]))
    needed = '.'.join(map(str, PYTHON))
    words = f'{found} (needed: {needed} or newer), {sys.executable}'
    if sys.version_info >= PYTHON:
        return Finding('python', Verdict.OK, words)
    return Finding('python', Verdict.FAIL, words, f'install Python {needed}')


def _package(name: str, reason: str) -> Finding:
    if reason:
        return Finding(name, Verdict.FAIL, f'cannot be imported: {reason}', SETUP)
    return Finding(name, Verdict.OK, installed(_DISTRIBUTIONS.get(name, name)) or 'source tree')


def installed(distribution: str) -> str:
    """Return the version of a distribution, empty if none is installed."""
    try:
        return metadata.version(distribution)
    except metadata.PackageNotFoundError:
        return ''


def lock_file() -> Path:
    """Return where the pinned versions are in a source tree."""
    return config_directory().parent / 'requirements.lock'


def versions(lock: Path) -> Finding:
    """Return whether the installed versions are those that were tested.

    Args:
        lock: a file with a line NAME==VERSION for each of them.

    """
    subject = 'versions'
    if not lock.is_file():
        return Finding(subject, Verdict.OK, 'those of this system: no requirements.lock here')
    pins = dict(
        line.strip().split('==', 1)
        for line in lock.read_text(encoding='utf-8').splitlines() if '==' in line
    )  # fmt: skip
    other = [
        f'{name} {installed(name) or "missing"} instead of {pin}'
        for name, pin in pins.items() if installed(name) != pin
    ]  # fmt: skip
    if not other:
        return Finding(subject, Verdict.OK, f'all {len(pins)} as in {lock}')
    more = f' and {len(other) - LISTED} more' if len(other) > LISTED else ''
    words = f'{", ".join(other[:LISTED])}{more}'
    return judged(True, subject, words, f'{SETUP}: only those of {lock.name} are tested')


def _configuration() -> Finding:
    told = defaults()
    if isinstance(told, Finding):
        return told
    directory = config_directory()
    scenes = ', '.join(scene_names(directory))
    return Finding(SUBJECT, Verdict.OK, f'{directory}; scenes: {scenes}')
