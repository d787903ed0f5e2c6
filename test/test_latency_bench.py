# SPDX-License-Identifier: Apache-2.0
"""The bench of latencies measures a live run: all of them, and none that cannot be."""

from pathlib import Path
import sys

import pytest

from srnn_bringup.latency import latencies as of
from srnn_bringup.page.timings import PLANNING

sys.path.insert(0, str(Path(__file__).parents[1] / 'bench'))
from latency_run import ALL_ACTIVE, FIRST_COMMAND, FIRST_SEGMENT, SHARE, RunFailedError, run

pytestmark = pytest.mark.slow

SEGMENTS = 24
"""Of 240 trials that touched something, 28 did so after segment 4, none after segment 24.

First entries of `contact_segments` in all rows of `srnn experiment table1` (--trials 20 --seed
5000, and --trials 10 --seed 7000).
"""


def test_a_recorded_run_tells_all_latencies(tmp_path):
    measured = run(tmp_path, SEGMENTS, seed=0)
    figures = measured.figures
    touches = len(figures[of.STOP])
    assert touches == len(figures[of.SHOWN]) == len(figures[of.STOPPED]) >= 1
    assert (figures[of.STOP] > figures[of.STOPPED]).all()
    assert (figures[of.STOPPED] > 0.0).all()
    parts = figures[of.SHARED] + figures[of.BEGUN] + figures[of.SENT]
    assert parts == pytest.approx(figures[of.ADAPTED])
    assert (figures[of.ADAPTED] > 0.0).all()
    assert len(figures[of.ANSWER]) == measured.joint_states - measured.unanswered > 100
    assert (figures[of.ANSWER] > 0.0).all()
    assert len(figures[SHARE]) >= len(figures[PLANNING]) == SEGMENTS
    assert (figures[SHARE] > 0.0).all()
    assert 0.0 < figures[FIRST_COMMAND][0] < figures[FIRST_SEGMENT][0]
    assert figures[ALL_ACTIVE][0] > 1000.0


def test_a_run_that_fails_says_why(tmp_path):
    (tmp_path / 'bag').mkdir()
    with pytest.raises(RunFailedError, match='seed 3: exit code 2: .* is there already'):
        run(tmp_path, SEGMENTS, seed=3)
