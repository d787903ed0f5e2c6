# SPDX-License-Identifier: Apache-2.0
"""What the processes of the graph find in their environment."""

from collections.abc import Mapping
from pathlib import Path

from srnn_bringup.config_lookup import config_directory
from srnn_bringup.dds_security.enclaves import enclave
from srnn_bringup.errors import ChoiceError

DOMAIN_ID = 'ROS_DOMAIN_ID'
DOMAIN_ID_MAX = 232
"""The middleware has no ports for more domains."""

DISCOVERY_RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'
DISCOVERY_RANGES = ('LOCALHOST', 'SUBNET', 'OFF', 'SYSTEM_DEFAULT')

PROFILES = 'FASTRTPS_DEFAULT_PROFILES_FILE'

_CHOSEN_BY_USER = (
    PROFILES,
    'FASTDDS_DEFAULT_PROFILES_FILE',
    'FASTDDS_BUILTIN_TRANSPORTS',
    'ROS_STATIC_PEERS',
)
"""Whoever sets one of these wants something else than the loopback profile."""

MIDDLEWARE = 'RMW_IMPLEMENTATION'
FAST_DDS = 'rmw_fastrtps_cpp'

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


def domain_id(environ: Mapping[str, str]) -> int:
    """Return the domain of the graph; the environment has been checked."""
    return int(environ.get(DOMAIN_ID) or 0)


def uses_loopback(environ: Mapping[str, str]) -> bool:
    """Tell whether the graph talks over the loopback interface, by `config/fastdds.xml`.

    So it does unless the user chose a wider range, another middleware or other transports.
    """
    return (
        (environ.get(DISCOVERY_RANGE) or 'LOCALHOST') == 'LOCALHOST'
        and (environ.get(MIDDLEWARE) or FAST_DDS) == FAST_DDS
        and not any(environ.get(name) for name in _CHOSEN_BY_USER)
    )


def graph_environment(
    environ: Mapping[str, str], keystore: Path | None = None
) -> dict[str, str]:
    """Return the environment of the whole graph.

    Unless the user decided otherwise, nobody outside this host takes part, and a node
    that was restarted is found at once. The ROS_DOMAIN_ID is that of the user.

    Args:
        environ: environment of the user.
        keystore: directory of the keystore that protects the graph, None for none.

    """
    # Matrices here are small: more threads only get in the way of the real-time loops.
    defaults = {DISCOVERY_RANGE: 'LOCALHOST', **dict.fromkeys(_THREADS, '1')}
    given = {name: value for name, value in environ.items() if value or name not in defaults}
    chosen = {**defaults, **given, 'PYTHONUNBUFFERED': '1'}
    if uses_loopback(environ):
        # For its LOCALHOST, the middleware would add shared memory to what a profile says.
        chosen[DISCOVERY_RANGE] = 'SYSTEM_DEFAULT'
        chosen[PROFILES] = str(config_directory() / 'fastdds.xml')
    return chosen if keystore is None else {**chosen, **security_variables(keystore)}


def security_variables(keystore: Path) -> dict[str, str]:
    """Return what makes ROS take part with the enclaves of a keystore, or not at all."""
    return {
        'ROS_SECURITY_KEYSTORE': str(keystore),
        'ROS_SECURITY_ENABLE': 'true',
        # Permissive says nothing and runs a node unprotected where its enclave is missing.
        'ROS_SECURITY_STRATEGY': 'Enforce',
    }


def security_arguments(member: str, keystore: Path | None) -> list[str]:
    """Return the ROS arguments that put a process into its enclave, none without a keystore."""
    return [] if keystore is None else ['--ros-args', '--enclave', enclave(member)]
