# SPDX-License-Identifier: Apache-2.0
"""Functions inside kernels against NumPy, and random words against their closed forms."""

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest
from sampling_oracle import Words
from statistical_bounds import binomial_bound

from srnn_planner.core.elementary import HIGHEST, LOWEST, exp, log
from srnn_planner.core.random_words import STEP, bernoulli_word, gap, seeds, uniform, word


@given(st.floats(LOWEST, HIGHEST))
def test_exponential_is_that_of_numpy(x):
    assert exp(x) == pytest.approx(np.exp(x), rel=1e-15)


@given(st.floats(1e-300, 1e300))
def test_logarithm_is_that_of_numpy(x):
    assert log(x) == pytest.approx(np.log(x), rel=1e-15, abs=1e-15)


@given(st.integers(0, 2**64 - 1))
def test_words_are_those_of_the_generator_in_plain_whole_numbers(seed):
    words, state = Words(seed), np.uint64(seed)
    for _ in range(5):
        assert int(word(state)) == words.word()
        with np.errstate(over='ignore'):
            state = state + STEP


def test_words_begin_as_published():
    """First words of SplitMix64 from state 0; its authors take the step before each word."""
    words = Words(STEP)
    assert words.word() == 0xE220A8397B1DCDAF
    assert words.word() == 0x6E789E6AA1B965F4


@pytest.mark.parametrize('probability', [0.0, 2.0**-12, 0.05, 0.3, 0.5, 0.999, 1.0])
def test_each_bit_of_a_word_is_set_with_the_probability(probability, rng):
    """Two-sided bounds of false-alarm rate 1e-6 for each of 64 bits, and for all together."""
    count = 4000
    state, drawn = seeds(rng, 1)[0], np.zeros((count, 64), dtype=bool)
    for n in range(count):
        bits, state = bernoulli_word(
            np.uint64(state), probability, np.uint64(2**64 - 1)
        )
        drawn[n] = (int(bits) >> np.arange(64, dtype=object)) & 1
    assert (
        np.abs(drawn.sum(axis=0) - count * probability) <= binomial_bound(count, probability)
    ).all()
    assert abs(drawn.sum() - drawn.size * probability) <= binomial_bound(drawn.size, probability)


def test_bits_that_are_not_wanted_are_not_set(rng):
    state = seeds(rng, 1)[0]
    for probability in (0.3, 1.0):
        bits, _ = bernoulli_word(state, probability, np.uint64(0b1011))
        assert int(bits) & ~0b1011 == 0


@pytest.mark.parametrize('probability', [2.0**-9, 0.1, 0.7])
def test_gaps_are_geometric(probability, rng):
    """How often a gap is at least n, against (1 - p)^n; two-sided, false-alarm rate 1e-6 each."""
    scale, count = 1.0 / np.log1p(-probability), 20_000
    gaps = np.array([gap(state, scale) for state in seeds(rng, count)])
    for n in (0, 1, 2, 5, 20, 500):
        expected = (1.0 - probability) ** n
        assert abs((gaps >= n).sum() - count * expected) <= binomial_bound(count, expected)


def test_uniform_numbers_fill_the_interval_evenly(rng):
    """Kolmogorov's statistic of 20000 numbers; false-alarm rate 2 exp(-2 n d^2) = 1e-6."""
    numbers = np.sort([uniform(state) for state in seeds(rng, 20_000)])
    steps = np.arange(len(numbers)) / len(numbers)
    distance = max(np.abs(numbers - steps).max(), np.abs(steps + 1 / len(numbers) - numbers).max())
    assert distance <= np.sqrt(np.log(2e6) / (2 * len(numbers)))
    assert numbers[-1] < 1.0
