# SPDX-License-Identifier: Apache-2.0
"""A force at rest is remembered for a tenth of a second."""

from lwr_tracking.core.load_check import SAMPLES, LoadCheck


def test_one_force_too_large_counts_until_it_is_long_ago():
    check = LoadCheck(5.0)
    assert not any(check.loaded(4.9) for _ in range(3 * SAMPLES))
    assert check.loaded(5.1)
    assert [check.loaded(0.0) for _ in range(SAMPLES)] == [True] * (SAMPLES - 1) + [False]
