# SPDX-License-Identifier: Apache-2.0
"""Gives fault tests one ledger for the whole run, and shows its table at the end."""

import hashlib
from pathlib import Path
import sys

from fault_ledger import FaultLedger
import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
HELPERS = ('test', 'src/lwr_tracking/test', 'src/srnn_node/test')
sys.path[:0] = [str(ROOT / folder) for folder in HELPERS]

LEDGER = pytest.StashKey[FaultLedger]()


def pytest_configure(config: pytest.Config) -> None:
    config.stash[LEDGER] = FaultLedger(config.getoption('--injections'))


@pytest.fixture
def ledger(request: pytest.FixtureRequest) -> FaultLedger:
    return request.config.stash[LEDGER]


@pytest.fixture
def rng(request: pytest.FixtureRequest) -> np.random.Generator:
    """Return a generator whose seed is derived from the name of the test."""
    digest = hashlib.sha256(request.node.nodeid.encode()).digest()
    return np.random.default_rng(int.from_bytes(digest[:8], 'little'))


def pytest_terminal_summary(terminalreporter, config: pytest.Config) -> None:
    if config.stash[LEDGER].injections:
        terminalreporter.section('injected faults')
        for line in config.stash[LEDGER].table():
            terminalreporter.write_line(line)
