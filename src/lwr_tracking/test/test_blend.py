# SPDX-License-Identifier: Apache-2.0
"""Laws of the fading start offset."""

import numpy as np

from lwr_tracking.core.blend import fade

OFFSET = np.array([0.01, -0.004])
SLOPE = np.array([-0.02, 0.01])
SPAN = 0.3


def test_it_starts_with_the_offset_and_ends_with_nothing():
    p, v, a = fade(np.array([0.0, SPAN, 1.0]), OFFSET, SLOPE, SPAN)
    np.testing.assert_allclose(p[0], OFFSET)
    np.testing.assert_allclose(v[0], SLOPE)
    np.testing.assert_allclose(a[0], 0.0, atol=1e-15)
    for values in (p, v, a):
        np.testing.assert_allclose(values[1:], 0.0, atol=1e-15)


def test_velocity_and_acceleration_are_its_derivatives():
    t = np.linspace(0.0, SPAN, 2001)
    p, v, a = fade(t, OFFSET, SLOPE, SPAN)
    np.testing.assert_allclose(np.gradient(p, t, axis=0)[1:-1], v[1:-1], atol=1e-6)
    np.testing.assert_allclose(np.gradient(v, t, axis=0)[1:-1], a[1:-1], atol=1e-5)


def test_it_never_grows_beyond_the_offset_without_a_slope():
    p, _, _ = fade(np.linspace(0.0, 1.0, 500), OFFSET, np.zeros(2), SPAN)
    assert np.all(np.abs(p) <= np.abs(OFFSET) + 1e-15)
