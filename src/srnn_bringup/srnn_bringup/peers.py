# SPDX-License-Identifier: Apache-2.0
"""Other hosts that parts of the graph run on, checked before anything starts."""

from dataclasses import dataclass
from ipaddress import IPv4Address, IPv6Address, ip_address
import socket

from srnn_bringup.errors import ChoiceError

Address = IPv4Address | IPv6Address

_ANY_PORT = 9
"""Where a route leads does not depend on the port, and nothing is sent."""


@dataclass(frozen=True)
class Peer:
    """Another host.

    Attributes:
        address: its address.
        own: the address of this host that it can be answered at.

    """

    address: Address
    own: Address


def find_peer(text: str) -> Peer:
    """Return the host that an address or a resolvable name stands for.

    Raises:
        ChoiceError: there is no such host, it cannot be reached from here, it is this
            host itself, or the address is none of a single host.

    """
    address = _resolve(text)
    if address.is_unspecified or address.is_multicast or str(address) == '255.255.255.255':
        raise ChoiceError(f'{text!r}: must be the address of one host')
    if address.is_link_local and address.version == 6:
        raise ChoiceError(f'{text!r}: is link-local; use another address of that host')
    own = _own_address(text, address)
    if own == address:
        raise ChoiceError(f'{text!r}: is this host itself; name the other one')
    return Peer(address, own)


def _resolve(text: str) -> Address:
    try:
        return ip_address(text)
    except ValueError:
        pass
    try:
        found = socket.getaddrinfo(text, None, type=socket.SOCK_DGRAM)
    except (OSError, UnicodeError) as error:
        why = getattr(error, 'strerror', None) or str(error)
        raise ChoiceError(
            f'{text!r}: must be an IPv4 or IPv6 address, or the name of a host: {why}'
        ) from error
    # Most networks of robots speak IPv4, and some only that.
    found.sort(key=lambda entry: entry[0] != socket.AF_INET)
    return ip_address(found[0][4][0])


def _own_address(text: str, address: Address) -> Address:
    family = socket.AF_INET if address.version == 4 else socket.AF_INET6
    with socket.socket(family, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect((str(address), _ANY_PORT))
        except OSError as error:
            raise ChoiceError(f'{text!r}: no way leads there: {error.strerror}') from error
        return ip_address(probe.getsockname()[0])
