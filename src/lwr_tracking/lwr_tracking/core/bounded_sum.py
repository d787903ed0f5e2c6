# SPDX-License-Identifier: Apache-2.0
"""A sum of small changes that does not run away."""

import numba


@numba.njit(cache=True)
def add_bounded(total, change, share, limit):
    """Return a total (3 numbers) plus `share` of a change, each of them within +-`limit`."""
    return (
        max(min(total[0] + share * change[0], limit), -limit),
        max(min(total[1] + share * change[1], limit), -limit),
        max(min(total[2] + share * change[2], limit), -limit),
    )
