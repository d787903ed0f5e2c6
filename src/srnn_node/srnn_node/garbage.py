# SPDX-License-Identifier: Apache-2.0
"""Keeps the garbage collector out of control loops.

A full collection with numba loaded stops a process for 75 ms. What is alive when a
node becomes active stays alive anyway, so it need not be looked at either.
"""

import gc


def freeze() -> None:
    """Take everything there is out of later collections, and stop collecting."""
    gc.freeze()
    gc.disable()


def thaw() -> None:
    """Collect as usual again."""
    gc.unfreeze()
    gc.enable()
