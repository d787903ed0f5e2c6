# SPDX-License-Identifier: Apache-2.0
"""Laws of the quintic Hermite path."""

import numpy as np
import pytest

from lwr_tracking.core.errors import PathError, TrackingError
from lwr_tracking.core.quintic_path import QuinticPath


def path_of(polynomials, times):
    knots = [np.stack([p.deriv(k)(times) if k else p(times) for p in polynomials], axis=1)
             for k in range(3)]
    return QuinticPath(times, *knots)


@pytest.fixture
def polynomials():
    rng = np.random.default_rng(7)
    return [np.polynomial.Polynomial(rng.normal(size=6)) for _ in range(2)]


def test_a_quintic_is_reproduced_exactly_from_uneven_knots(polynomials):
    path = path_of(polynomials, np.array([0.0, 0.1, 0.15, 0.6, 1.0]))
    t = np.linspace(0.0, 1.0, 101)
    for k, values in enumerate(path.evaluate(t)):
        expected = np.stack([p.deriv(k)(t) if k else p(t) for p in polynomials], axis=1)
        np.testing.assert_allclose(values, expected, atol=1e-8)


def test_scalar_and_array_evaluation_agree(polynomials):
    path = path_of(polynomials, np.array([0.0, 0.3, 1.0]))
    for t in (0.0, 0.1, 0.3, 0.77, 1.0):
        p, v, _ = path.evaluate(np.array([t]))
        np.testing.assert_allclose(path.state(t), np.concatenate((p[0], v[0])), atol=1e-12)


def test_every_knot_is_met_whatever_its_numbers():
    rng = np.random.default_rng(3)
    times = np.append(0.0, np.cumsum(rng.uniform(0.01, 0.1, 20)))
    knots = [rng.normal(size=(21, 2)) for _ in range(3)]
    path = QuinticPath(times, *knots)
    for side in (times + 1e-12, times - 1e-12):
        for values, expected in zip(path.evaluate(side), knots, strict=True):
            np.testing.assert_allclose(values, expected, atol=1e-4)
    assert path.end == (*knots[0][-1], *knots[1][-1])


def test_the_ends_are_held():
    zero = np.zeros((2, 2))
    path = QuinticPath(np.array([0.0, 1.0]), np.array([[0.0, 0.0], [1.0, 2.0]]), zero, zero)
    assert path.state(-1.0) == path.state(0.0)
    assert path.state(9.0)[:2] == (1.0, 2.0)


@pytest.mark.parametrize('times', [[0.0], [0.1, 1.0], [0.0, 0.0], [0.0, 1.0, 0.5], [0.0, np.nan]])
def test_impossible_times_are_named(times):
    zero = np.zeros((len(times), 2))
    with pytest.raises(PathError) as error:
        QuinticPath(np.array(times), zero, zero, zero)
    assert isinstance(error.value, TrackingError)
    assert isinstance(error.value, ValueError)
