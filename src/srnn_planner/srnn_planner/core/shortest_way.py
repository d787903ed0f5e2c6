# SPDX-License-Identifier: Apache-2.0
"""Shortest ways in a directed graph, compiled."""

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
    for k in range(len(start)):
        if start[k] < np.inf:
            heapq.heappush(queue, (start[k], k))
    while len(queue) > 0:
        d, i = heapq.heappop(queue)
        if d > distance[i]:
            continue
        for e in range(first[i], first[i + 1]):
            k = np.int64(pre[e])
            total = d + length[e] * (tolls[e] + fatigue[k])
            if total < distance[k]:
                distance[k] = total
                heapq.heappush(queue, (total, k))
    return distance
