# SPDX-License-Identifier: Apache-2.0
"""Shortest ways in a directed graph: compiled, and the plain NumPy reference."""

import heapq

import numba
import numpy as np


@numba.njit(cache=True)
def distances(first, pre, length, tolls, fatigue, start):
    """Return the length of the shortest way from every node, by Dijkstra's algorithm.

    Args:
        first: (K + 1,) the edges into node i are first[i] ... first[i + 1] - 1.
        pre: (E,) node in which each edge begins.
        length: (E,) of each edge, at least 0.
        tolls: (E,) how often it counts, at least 0.
        fatigue: (K,) edges from each node count as much more often.
        start: (K,) length that remains at each node where ways may end, elsewhere infinite.

    Returns:
        (K,) infinite where no way leads on.

    """
    distance = start.copy()
    queue = [(0.0, 0)]
    queue.clear()
    for i in range(len(start)):
        if start[i] < np.inf:
            heapq.heappush(queue, (start[i], i))
    while len(queue) > 0:
        d, i = heapq.heappop(queue)
        if d > distance[i]:
            continue
        for e in range(first[i], first[i + 1]):
            # A sum has 64 bits, as the other numbers of nodes in the queue.
            k = 0 + pre[e]
            total = d + length[e] * (tolls[e] + fatigue[k])
            if total < distance[k]:
                distance[k] = total
                heapq.heappush(queue, (total, k))
    return distance


def relaxed(first, pre, length, tolls, fatigue, start):
    """Return what `distances` returns: all edges at once, until none shortens a way any more."""
    distance = start.copy()
    post = np.repeat(np.arange(len(start)), np.diff(first))
    # Sorted by where they begin, edges from one node are side by side.
    order = np.argsort(pre, kind='stable')
    cost = (length * (tolls + fatigue[pre]))[order]
    target, begins = post[order], np.searchsorted(pre[order], np.arange(len(start)))
    leaving = np.flatnonzero(np.bincount(pre, minlength=len(start)))
    while True:
        ways = np.minimum.reduceat(cost + distance[target], begins[leaving])
        shorter = np.minimum(distance[leaving], ways)
        if np.array_equal(shorter, distance[leaving]):
            return distance
        distance[leaving] = shorter
