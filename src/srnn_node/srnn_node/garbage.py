# SPDX-License-Identifier: Apache-2.0
"""Keeps the garbage collector out of control loops.

A full collection with scipy and numba loaded stops a process for 75 ms. What is
alive when a node becomes active stays alive anyway.
"""

import gc


def freeze() -> None:
    """Collect once, take everything alive out of later collections, and stop collecting."""
    gc.collect()
    gc.freeze()
    gc.disable()


def thaw() -> None:
    """Collect as usual again."""
    gc.unfreeze()
    gc.enable()
