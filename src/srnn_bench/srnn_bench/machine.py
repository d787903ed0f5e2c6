# SPDX-License-Identifier: Apache-2.0
"""On what was measured: machine, and versions of what was used."""

from importlib import metadata
import os
from pathlib import Path
import platform

from srnn_bench.peers import NOT_INSTALLED, PEERS

_OWN = ('numpy', 'numba', 'llvmlite')
"""Distributions that the planner's speed depends on."""

_PROCESSOR = Path('/proc/cpuinfo')


def machine_facts() -> dict[str, str]:
    """Return processor, cores, operating system, Python and versions, by what they are."""
    facts = {
        'processor': processor(),
        'cores': f'{len(os.sched_getaffinity(0))} usable of {os.cpu_count()}',
        'load': f'{os.getloadavg()[0]:.1f} before the run',
        'operating system': platform.platform(),
        'Python': platform.python_version(),
        'versions': _joined({name: metadata.version(name) for name in _OWN}),
    }
    for peer in PEERS:
        facts[peer.name] = _joined(peer.versions()) or NOT_INSTALLED
    return facts


def processor() -> str:
    """Return what the processor is called."""
    lines = _PROCESSOR.read_text(encoding='utf-8').splitlines() if _PROCESSOR.exists() else []
    models = [line.partition(':')[2].strip() for line in lines if line.startswith('model name')]
    return models[0] if models else platform.processor() or platform.machine()


def _joined(versions: dict[str, str]) -> str:
    return ', '.join(f'{name} {version}' for name, version in versions.items())
