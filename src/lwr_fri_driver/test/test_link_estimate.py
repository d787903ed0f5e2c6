# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from lwr_fri_driver.core.link_estimate import WINDOW, LinkEstimate
from lwr_fri_driver.core.words import Quality

CYCLE = 0.005


def run(link, cycles, missing=(), late=(), start=0.0):
    last = -1
    for n in range(cycles):
        if n in missing:
            continue
        link.heard(start + n * CYCLE, n - last)
        link.answered(0.006 if n in late else 0.0005)
        last = n


def test_nothing_is_known_before_a_full_window():
    link = LinkEstimate(CYCLE)
    assert (link.share, link.quality) == (0.0, Quality.UNACCEPTABLE)
    run(link, WINDOW - 1)
    assert (link.share, link.quality) == (1.0, Quality.UNACCEPTABLE)


@pytest.mark.parametrize(('bad', 'quality'), [
    (0, Quality.PERFECT), (1, Quality.PERFECT), (2, Quality.OK), (5, Quality.OK),
    (6, Quality.BAD), (10, Quality.BAD), (11, Quality.UNACCEPTABLE),
])  # fmt: skip
@pytest.mark.parametrize('kind', ['missing', 'late'])
def test_the_share_of_good_cycles_decides(bad, quality, kind):
    link = LinkEstimate(CYCLE)
    run(link, WINDOW + 20, **{kind: range(30, 30 + 2 * bad, 2)})
    assert link.share == pytest.approx(1.0 - bad / WINDOW)
    assert link.quality is quality


def test_a_long_gap_spoils_the_whole_window_and_heals_with_it():
    link = LinkEstimate(CYCLE)
    run(link, 500, missing=range(200, 450))
    assert link.quality is Quality.UNACCEPTABLE
    run(link, 100, start=2.5)
    assert link.quality is Quality.PERFECT


def test_jitter_is_that_of_the_packets_whatever_is_missing():
    rng = np.random.default_rng(3)
    link, last = LinkEstimate(CYCLE), 0
    for n in range(1, 4000):
        if rng.random() < 0.1:
            continue
        link.heard(n * CYCLE + rng.normal(0.0, 0.0003), n - last)
        link.answered(0.0)
        last = n
    # Each deviation is a difference of two of them; 2000 give the figure to 5 % at 3 sigma.
    assert link.jitter == pytest.approx(np.sqrt(2.0) * 0.0003, rel=0.05)


def test_delays_are_told_as_percentiles():
    link = LinkEstimate(CYCLE)
    assert link.delays([50, 99]) == [0.0, 0.0]
    for n in range(1, 101):
        link.heard(n * CYCLE, 1)
        link.answered(n * 1e-5)
    assert link.delays([0, 50, 100]) == pytest.approx([1e-5, 50.5e-5, 100e-5])
