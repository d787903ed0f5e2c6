# SPDX-License-Identifier: Apache-2.0
"""Row 27: what runs for long stays what it was; three minutes of it, and the judge itself."""

import mmap
import os
from pathlib import Path
import subprocess
import sys

import numpy as np
import pytest

BENCH = Path(__file__).parents[2] / 'bench'
sys.path.insert(0, str(BENCH))

from soak_record import Heartbeat, JointRecord, growth_mb, resident_mb  # noqa: E402

from lwr_description import POSITION_MAX  # noqa: E402
from srnn_msgs_py.health import Health, HealthLevel  # noqa: E402

MINUTES = 3.0


def test_growth_is_that_after_the_warm_up_whatever_was_before_and_whatever_goes_up_and_down():
    times = np.arange(0.0, 3600.0, 5.0)
    rng = np.random.default_rng(1)
    sizes = 200.0 + 0.002 * times + rng.uniform(-1.0, 1.0, times.size)
    sizes[times < 300.0] -= 150.0
    assert growth_mb(times, sizes, 300.0) == pytest.approx(0.002 * (times[-1] - 300.0), rel=0.05)
    assert growth_mb([0.0, 1.0], [1.0, 2.0], 10.0) == 0.0


def test_a_report_that_stays_out_is_a_gap_also_at_the_end():
    beat = Heartbeat()
    for now in (0.0, 1.0, 3.5, 4.5):
        beat.beat(Health(HealthLevel.OK, 'active', {'cycles': now}), now)
    assert (beat.count, beat.gap, beat.figure('cycles')) == (4, 2.5, 4.5)
    beat.silence(9.0)
    assert beat.gap == 4.5
    assert not beat.troubles
    beat.beat(Health(HealthLevel.WARN, 'late'), 9.0)
    assert beat.troubles == {'WARN late': 1}


def test_joint_states_that_are_no_numbers_or_beyond_a_limit_are_counted():
    record = JointRecord()
    for position in (np.zeros(7), POSITION_MAX, 1.001 * POSITION_MAX, np.full(7, np.nan)):
        record.add(position)
    assert (record.samples, record.beyond, record.not_finite) == (4, 1, 1)


def test_memory_of_a_process_is_told():
    # A mapping of its own: what the allocator gets back it may keep, and then nothing changes.
    with mmap.mmap(-1, 240_000_000, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS) as held:
        for _ in range(240):
            held.write(b'\1' * 1_000_000)
        before = resident_mb(os.getpid())
    assert before - resident_mb(os.getpid()) == pytest.approx(240.0, rel=0.2)


@pytest.mark.slow
def test_the_graph_stays_what_it_was(ledger, tmp_path):
    out = tmp_path / 'soak.md'
    with ledger.injection(27, f'{MINUTES:g} minutes of running'):
        command = [sys.executable, BENCH / 'soak.py', '--minutes', f'{MINUTES:g}', '--out', out]
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=60.0 * MINUTES + 300.0, check=False
        )
        print(done.stdout)
        assert done.returncode == 0, done.stdout + done.stderr
        assert out.read_text() in done.stdout
