# SPDX-License-Identifier: Apache-2.0
"""Random numbers inside kernels: SplitMix64 (Steele, Lea and Flood 2014).

The state is one word, so that it stays in a register, and numbers do not wait for each
other. Whoever draws from it begins at a word of a `np.random.Generator`.
"""

import numba
import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.elementary import log

STEP = np.uint64(0x9E3779B97F4A7C15)
_FIRST, _SECOND = np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
_A, _B, _C = np.uint64(30), np.uint64(27), np.uint64(31)
_TOP, _UNIT = np.uint64(11), 2.0**-53


def seeds(rng: np.random.Generator, count: int) -> NDArray[np.uint64]:
    """Return `count` states to begin at."""
    return rng.integers(0, 2**64, count, dtype=np.uint64)


@numba.njit(cache=True)
def word(state):
    """Return the random word of a state; the next state is `state + STEP`."""
    mixed = (state ^ (state >> _A)) * _FIRST
    mixed = (mixed ^ (mixed >> _B)) * _SECOND
    return mixed ^ (mixed >> _C)


@numba.njit(cache=True)
def uniform(state):
    """Return the random number of a state, from [0, 1), with 53 bits."""
    return float(word(state) >> _TOP) * _UNIT


@numba.njit(cache=True)
def gap(state, scale):
    """Return how many trials fail before one succeeds.

    Args:
        state: see `word`.
        scale: 1 / log(1 - p) for the probability p of success.

    """
    # 1 - u is never 0.
    return np.int64(log(1.0 - uniform(state)) * scale)


@numba.njit(cache=True)
def bernoulli_word(state, probability, wanted):
    """Return a word whose bits are set with a probability, and the next state.

    64 random numbers are compared with the probability bit by bit, from the highest on, until
    all that are wanted are decided: after two to six words, instead of one for each number.

    Args:
        state: see `word`.
        probability: from [0, 1].
        wanted: which bits are wanted; the others are 0.

    """
    if probability >= 1.0:
        return wanted, state
    drawn, undecided = np.uint64(0), wanted
    while probability > 0.0 and undecided != 0:
        probability *= 2.0
        random = word(state)
        state += STEP
        if probability >= 1.0:
            probability -= 1.0
            drawn |= undecided & ~random
            undecided &= random
        else:
            undecided &= ~random
    return drawn, state
