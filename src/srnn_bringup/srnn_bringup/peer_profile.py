# SPDX-License-Identifier: Apache-2.0
"""The profile of the middleware that lets the graph talk to other hosts, named one by one."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from ipaddress import ip_address
import os
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from srnn_bringup.config_lookup import config_directory
from srnn_bringup.environment import DISCOVERY_RANGE, DOMAIN_ID, PROFILES, uses_loopback
from srnn_bringup.errors import ChoiceError
from srnn_bringup.peers import Address, Peer

FILE = 'fastdds.xml'
LOOPBACK: dict[int, Address] = {4: ip_address('127.0.0.1'), 6: ip_address('::1')}

FIRST_PORT = 7410
PORTS_OF_DOMAIN = 250
"""Where the first participant of domain 0 listens, and how far the next domain is."""

PARTICIPANTS = 10
"""So many processes of another host are called; the others find this host by themselves."""

_NAMESPACE = 'http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles'


@contextmanager
def talking_to(peers: Sequence[Peer]) -> Iterator[None]:
    """Let this process, and those it starts meanwhile, talk to other hosts.

    Without peers nothing changes.

    Raises:
        ChoiceError: the user has chosen another range, middleware or profile.

    """
    if not peers:
        yield
        return
    if not uses_loopback(os.environ):
        raise ChoiceError(
            '--peer is for the middleware as it comes: unset RMW_IMPLEMENTATION, '
            f'{DISCOVERY_RANGE}, ROS_STATIC_PEERS, {PROFILES} and FASTDDS_BUILTIN_TRANSPORTS, '
            'or name the peers there'
        )
    before = {name: os.environ.get(name) for name in (DISCOVERY_RANGE, PROFILES)}
    with TemporaryDirectory(prefix='srnn_') as directory:
        file = Path(directory) / FILE
        file.write_text(peer_profile(peers, int(os.environ.get(DOMAIN_ID) or 0)), encoding='utf-8')
        os.environ.update({DISCOVERY_RANGE: 'SYSTEM_DEFAULT', PROFILES: str(file)})
        try:
            yield
        finally:
            for name, value in before.items():
                os.environ.pop(name)
                os.environ.update({} if value is None else {name: value})


def peer_profile(peers: Sequence[Peer], domain: int) -> str:
    """Return the loopback profile of `config/fastdds.xml`, widened to some hosts.

    The addresses of this host are written down, because Fast DDS takes those of a link
    that is down when a node starts for gone for ever, and so it does with a list of
    interfaces. It cannot use both versions of IP at once.

    Args:
        peers: the hosts, one or more.
        domain: ROS domain of the graph.

    Raises:
        ChoiceError: some hosts are named by IPv4 and others by IPv6.

    """
    versions = {peer.address.version for peer in peers}
    if len(versions) > 1:
        raise ChoiceError('--peer: name all hosts by IPv4, or all by IPv6')
    version = versions.pop()
    ElementTree.register_namespace('', _NAMESPACE)
    root = ElementTree.parse(config_directory() / FILE).getroot()
    transport = _find(root, 'transport_descriptor')
    transport.remove(_find(transport, 'interfaceWhiteList'))
    _find(transport, 'type').text = f'UDPv{version}'
    here = (LOOPBACK[version], *dict.fromkeys(peer.own for peer in peers))
    listening = _find(root, 'metatrafficUnicastLocatorList')
    calling = _find(root, 'initialPeersList')
    listening.clear()
    calling.clear()
    _add_locators(listening, here)
    _add_locators(SubElement(_find(root, 'rtps'), _tag('defaultUnicastLocatorList')), here)
    _add_locators(calling, [LOOPBACK[version]])
    first = FIRST_PORT + PORTS_OF_DOMAIN * domain
    for port in range(first, first + 2 * PARTICIPANTS, 2):
        _add_locators(calling, dict.fromkeys(peer.address for peer in peers), port)
    return ElementTree.tostring(root, encoding='unicode')


def _add_locators(
    parent: Element, addresses: Iterable[Address], port: int | None = None
) -> None:
    for address in addresses:
        locator = SubElement(parent, _tag('locator'))
        kind = SubElement(locator, _tag(f'udpv{address.version}'))
        if port is not None:
            SubElement(kind, _tag('port')).text = str(port)
        SubElement(kind, _tag('address')).text = str(address)


def _find(root: Element, name: str) -> Element:
    found = root.find(f'.//{_tag(name)}')
    if found is None:
        raise ChoiceError(f'{config_directory() / FILE}: has no {name}')
    return found


def _tag(name: str) -> str:
    return f'{{{_NAMESPACE}}}{name}'
