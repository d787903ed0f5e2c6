# SPDX-License-Identifier: Apache-2.0
"""Where a generator of random numbers stands, as six numbers that can be kept."""

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.errors import WeightsError

LENGTH = 6
_HALF = 64
_MASK = (1 << _HALF) - 1


def read(rng: np.random.Generator) -> NDArray[np.uint64]:
    """Return the state (6,) of a PCG64 generator."""
    whole = rng.bit_generator.state
    state, increment = whole['state']['state'], whole['state']['inc']
    return np.array(
        [
            state >> _HALF, state & _MASK, increment >> _HALF, increment & _MASK,
            whole['has_uint32'], whole['uinteger'],
        ],
        dtype=np.uint64,
    )  # fmt: skip


def write(rng: np.random.Generator, state: NDArray[np.uint64]) -> None:
    """Let a PCG64 generator go on from a state (6,).

    Raises:
        WeightsError: such a generator has no such state; it stays where it is.

    """
    high, low, increment_high, increment_low, has_half, half = (int(n) for n in state)
    # The increment of this generator is odd, and the half that is left over has 32 bits.
    if not increment_low & 1 or has_half > 1 or half >> 32:
        raise WeightsError(f'{state.tolist()} is no state of the random number generator')
    rng.bit_generator.state = {
        'bit_generator': 'PCG64',
        'state': {
            'state': high << _HALF | low,
            'inc': increment_high << _HALF | increment_low,
        },
        'has_uint32': has_half,
        'uinteger': half,
    }
