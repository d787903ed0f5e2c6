# SPDX-License-Identifier: Apache-2.0
"""The closed form is the singular value decomposition."""

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from lwr_tracking.core.manipulability import smallest_singular_value


@given(st.integers(0, 2**32 - 1), st.floats(1e-3, 1.0))
def test_it_is_that_of_the_decomposition(seed, smallest):
    rng = np.random.default_rng(seed)
    jacobian = rng.normal(size=(3, 7))
    u, s, v = np.linalg.svd(jacobian, full_matrices=False)
    s = np.array((1.0, rng.uniform(smallest, 1.0), smallest))
    jacobian = u @ np.diag(s) @ v
    assert smallest_singular_value(jacobian @ jacobian.T) == pytest.approx(smallest, rel=1e-6)


@pytest.mark.parametrize('size', [0.0, 0.5, 2.0])
def test_equal_singular_values_are_no_exception(size):
    assert smallest_singular_value(size**2 * np.eye(3)) == pytest.approx(size)
