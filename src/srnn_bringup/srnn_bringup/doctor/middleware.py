# SPDX-License-Identifier: Apache-2.0
"""The middleware: which it is, whom it reaches, and whether messages arrive."""

from collections.abc import Iterator, Mapping

from srnn_bringup.doctor import probes
from srnn_bringup.doctor.finding import Finding, Verdict, judged
from srnn_bringup.doctor.messages import Heard, exchange
from srnn_bringup.doctor.software import SETUP, installed
from srnn_bringup.environment import (
    DISCOVERY_RANGE,
    DOMAIN_ID,
    FAST_DDS,
    MIDDLEWARE,
    check_environment,
    uses_loopback,
)
from srnn_bringup.errors import BringupError, ChoiceError
from srnn_msgs_py.topics import NODES

RECEIVE_QUEUE = 1 << 20
"""Bytes that `config/fastdds.xml` asks for: some messages of weights fit into it."""

_PARTS = ('ros-rclpy', 'ros-rmw-fastrtps-cpp', 'ros-fastrtps')


def middleware(environ: Mapping[str, str]) -> Iterator[Finding]:
    """Yield what the middleware is, and what it does when it is tried out."""
    yield _kind(environ)
    yield _versions()
    yield _receive_queue(probes.receive_queue_bytes())
    try:
        check_environment(environ)
    except ChoiceError as error:
        yield Finding('environment', Verdict.FAIL, str(error), 'set it anew, or unset it')
        return
    yield _discovery(environ)
    heard = exchange(environ)
    yield _messages(heard)
    yield _domain(environ, heard)
    yield _security(environ)


def _kind(environ: Mapping[str, str]) -> Finding:
    chosen = environ.get(MIDDLEWARE) or FAST_DDS
    return judged(
        chosen != FAST_DDS, MIDDLEWARE,
        chosen if chosen == FAST_DDS else f'{chosen}: only {FAST_DDS} is tested',
        f'unset {MIDDLEWARE}',
    )  # fmt: skip


def _versions() -> Finding:
    found = {name: installed(name) for name in _PARTS}
    words = ', '.join(f'{name} {version}' for name, version in found.items() if version)
    return Finding('middleware', Verdict.OK, words or 'that of the ROS 2 installation')


def _discovery(environ: Mapping[str, str]) -> Finding:
    if uses_loopback(environ):
        return Finding('discovery', Verdict.OK, 'this host only, over the loopback interface')
    wide = environ.get(DISCOVERY_RANGE) or 'LOCALHOST'
    local = wide in ('LOCALHOST', 'OFF')
    words = f'{DISCOVERY_RANGE} = {wide}, with transports of your choice'
    risk = '' if local else ': other hosts can take part, and command the arm'
    advice = f'unset {DISCOVERY_RANGE}, or give the nodes a key: srnn up --key FILE'
    return judged(not local, 'discovery', words + risk, advice)


def _messages(heard: Heard) -> Finding:
    if heard.failure:
        advice = (
            'see that the interface is up (ip link show lo) and no firewall blocks UDP on it; '
            f'else {SETUP}'
        )
        return Finding('messages', Verdict.FAIL, heard.failure, advice)
    words = f'one of another process arrived after {heard.seconds:.1f} s ({heard.middleware})'
    return Finding('messages', Verdict.OK, words)


def _domain(environ: Mapping[str, str], heard: Heard) -> Finding:
    domain = environ.get(DOMAIN_ID) or '0'
    if not heard.others:
        return Finding(DOMAIN_ID, Verdict.OK, f'{domain}; no others are seen in it')
    ours = ', a graph of srnn among them' if set(heard.others) & set(NODES) else ''
    words = f'{domain} is in use{ours}: {", ".join(heard.others)}'
    advice = f'if these are not yours, choose another: export {DOMAIN_ID}=N'
    return Finding(DOMAIN_ID, Verdict.WARN, words, advice)


def _receive_queue(allowed: int) -> Finding:
    if allowed >= RECEIVE_QUEUE:
        return Finding('receive queue', Verdict.OK, f'{RECEIVE_QUEUE} bytes are allowed')
    words = f'{allowed} bytes, {RECEIVE_QUEUE} wanted: recordings may have gaps'
    advice = f'sudo sysctl -w net.core.rmem_max={RECEIVE_QUEUE}'
    return Finding('receive queue', Verdict.WARN, words, advice)


def _security(environ: Mapping[str, str]) -> Finding:
    try:
        from srnn_bringup.dds_security.enforcement import lack_of_security

        lack = lack_of_security(environ)
    except (BringupError, ImportError) as error:
        lack = str(error)
    if lack:
        words = f'not available ({lack})'
        return Finding('DDS security', Verdict.WARN, words, 'use a key: srnn up --key FILE')
    return Finding('DDS security', Verdict.OK, 'available: srnn up --secure KEYSTORE')
