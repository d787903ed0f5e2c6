# SPDX-License-Identifier: Apache-2.0
"""Which code makes the decisions here, so that a recording can tell whether it still does."""

from functools import cache
import hashlib
from importlib import import_module, metadata
from pathlib import Path
import platform
import subprocess
import sys

DECIDING = (
    'srnn_config', 'srnn_msgs_py', 'lwr_description', 'lwr_tracking', 'srnn_planner',
)  # fmt: skip
"""Packages whose code makes decisions."""

LIBRARIES = ('numpy', 'numba', 'llvmlite', 'mujoco')
"""Packages whose numbers are part of decisions."""

GIT_S = 5.0


@cache
def code_version() -> dict[str, str]:
    """Return what decisions depend on besides configuration and input.

    Returns:
        ``code``: hash of the deciding packages; ``commit``: of the source tree, if it is one;
        ``python``, ``machine``, and the version of every library.

    """
    return {
        'code': fingerprint(),
        'commit': _commit(),
        'python': platform.python_version(),
        'machine': f'{platform.machine()} {_processor()}'.strip(),
        **{name: metadata.version(name) for name in LIBRARIES},
    }


def fingerprint() -> str:
    """Return a hash of every source file of the deciding packages."""
    digest = hashlib.sha256()
    for package in DECIDING:
        (folder,) = import_module(package).__path__
        for file in sorted(Path(folder).rglob('*.py')):
            content = file.read_bytes()
            digest.update(f'{package}/{file.relative_to(folder)} {len(content)}\n'.encode())
            digest.update(content)
    return digest.hexdigest()[:16]


def _commit() -> str:
    """Return the commit of the source tree, with a + if files have changed; empty for none."""
    folder = Path(__file__).resolve().parent
    try:
        commit = _git(folder, 'rev-parse', '--short=12', 'HEAD')
        return commit + ('+' if _git(folder, 'status', '--porcelain', '-uno') else '')
    except (OSError, subprocess.SubprocessError):
        return ''


def _git(folder: Path, *arguments: str) -> str:
    done = subprocess.run(
        ['git', '-C', str(folder), *arguments],
        capture_output=True, text=True, check=True, timeout=GIT_S,
    )  # fmt: skip
    return done.stdout.strip()


def _processor() -> str:
    if sys.platform != 'linux':
        return platform.processor()
    for line in Path('/proc/cpuinfo').read_text(encoding='utf-8').splitlines():
        name, _, value = line.partition(':')
        if name.strip() == 'model name':
            return value.strip()
    return ''
