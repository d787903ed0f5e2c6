# SPDX-License-Identifier: Apache-2.0
"""Times calls in turn, so that all of them see the same machine."""

from collections.abc import Callable
from dataclasses import dataclass
import os
import platform
import time

import numpy as np

from srnn_bench.machine import processor


@dataclass(frozen=True)
class Times:
    """What calls have taken [ms]."""

    p50: float
    p99: float
    least: float


TURN = 10
"""Calls in a row; one before them does not count: it finds the caches full of others' data."""


def times_ms(
    *calls: Callable[[], object], repeats: int, clock: Callable[[], float] = time.perf_counter
) -> list[Times]:
    """Time calls in turn, `TURN` of each at a time, by a clock in seconds."""
    spent: list[list[float]] = [[] for _ in calls]
    for _ in range(-(-repeats // TURN)):
        for call, row in zip(calls, spent, strict=True):
            call()
            for _ in range(TURN):
                began = clock()
                call()
                row.append(1e3 * (clock() - began))
    return [Times(*np.percentile(row, (50, 99, 0)).tolist()) for row in spent]


def machine() -> str:
    """Return the processor, how many of it, and versions, in one line."""
    return f'{processor()}, {os.cpu_count()} cores, Python {platform.python_version()}'
