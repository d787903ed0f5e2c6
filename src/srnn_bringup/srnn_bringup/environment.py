# SPDX-License-Identifier: Apache-2.0
"""What the processes of the graph find in their environment."""

from collections.abc import Mapping

from srnn_bringup.config import config_directory
from srnn_bringup.errors import ChoiceError

DOMAIN_ID = 'ROS_DOMAIN_ID'
DOMAIN_ID_MAX = 232
"""The middleware has no ports for more domains."""

DISCOVERY_RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'
DISCOVERY_RANGES = ('LOCALHOST', 'SUBNET', 'OFF', 'SYSTEM_DEFAULT')

PROFILES = 'FASTRTPS_DEFAULT_PROFILES_FILE'
TRANSPORTS = 'FASTDDS_BUILTIN_TRANSPORTS'

_THREADS = ('OPENBLAS_NUM_THREADS', 'OMP_NUM_THREADS', 'MKL_NUM_THREADS', 'NUMBA_NUM_THREADS')


def check_environment(environ: Mapping[str, str]) -> None:
    """Refuse what the middleware would break on, or silently take for something else.

    Raises:
        ChoiceError: a variable has an impossible value.

    """
    domain = environ.get(DOMAIN_ID) or '0'
    if not (domain.isdecimal() and int(domain) <= DOMAIN_ID_MAX):
        raise ChoiceError(f'{DOMAIN_ID} = {domain!r}: must be 0 to {DOMAIN_ID_MAX}')
    wide = environ.get(DISCOVERY_RANGE) or 'LOCALHOST'
    if wide not in DISCOVERY_RANGES:
        raise ChoiceError(
            f'{DISCOVERY_RANGE} = {wide!r}: must be one of {", ".join(DISCOVERY_RANGES)}'
        )


def graph_environment(environ: Mapping[str, str]) -> dict[str, str]:
    """Return the environment of the whole graph.

    Unless the user decided otherwise, nobody outside this host takes part, and new
    participants announce themselves often. The ROS_DOMAIN_ID is that of the user.
    """
    defaults = {
        DISCOVERY_RANGE: 'LOCALHOST',
        PROFILES: str(config_directory() / 'fastdds.xml'),
        # After a SIGKILL, shared memory delays the successor of the process by seconds.
        TRANSPORTS: 'UDPv4',
    }
    # Matrices here are small: more threads only get in the way of the real-time loops.
    defaults.update(dict.fromkeys(_THREADS, '1'))
    return {**defaults, **environ, 'PYTHONUNBUFFERED': '1'}
