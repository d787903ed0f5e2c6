# SPDX-License-Identifier: Apache-2.0
"""What the processes of the graph find in their environment."""

from collections.abc import Mapping

from srnn_node.realtime import VARIABLE as REALTIME_PRIORITY

DISCOVERY_RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'

_THREADS = ('OPENBLAS_NUM_THREADS', 'OMP_NUM_THREADS', 'MKL_NUM_THREADS', 'NUMBA_NUM_THREADS')


def graph_environment(environ: Mapping[str, str]) -> dict[str, str]:
    """Return the environment of the whole graph.

    Unless the user decided otherwise, nobody outside this host takes part. The
    ROS_DOMAIN_ID is that of the user.
    """
    defaults = {DISCOVERY_RANGE: 'LOCALHOST'}
    # Matrices here are small: more threads only get in the way of the real-time loops.
    defaults.update(dict.fromkeys(_THREADS, '1'))
    return {**defaults, **environ, 'PYTHONUNBUFFERED': '1'}


def node_environment(environ: Mapping[str, str], real_time: bool) -> dict[str, str]:
    """Return the environment of one node; only those that move the arm get priority."""
    environment = graph_environment(environ)
    if not real_time:
        environment[REALTIME_PRIORITY] = '0'
    return environment
