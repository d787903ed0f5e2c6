# SPDX-License-Identifier: Apache-2.0
"""A sum of small changes that does not run away."""

import numba


@numba.njit(cache=True)
def add_bounded(total, change, share, limit):
    """Add `share` of a change (n,) to a total (n,), in place and within +-`limit`."""
    for i in range(total.shape[0]):
        total[i] = max(min(total[i] + share * change[i], limit), -limit)
