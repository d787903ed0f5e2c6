# SPDX-License-Identifier: Apache-2.0
"""The profile of the middleware that lets the graph talk to other hosts, named one by one."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from ipaddress import IPv4Address, IPv6Address, ip_address
import os
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from srnn_bringup.config import config_directory
from srnn_bringup.environment import DISCOVERY_RANGE, PROFILES, uses_loopback
from srnn_bringup.errors import ChoiceError
from srnn_bringup.peers import Peer

FILE = 'fastdds.xml'
LOOPBACK = ip_address('127.0.0.1')

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
        file.write_text(peer_profile(peers), encoding='utf-8')
        os.environ.update({DISCOVERY_RANGE: 'SYSTEM_DEFAULT', PROFILES: str(file)})
        try:
            yield
        finally:
            for name, value in before.items():
                os.environ.pop(name)
                os.environ.update({} if value is None else {name: value})


def peer_profile(peers: Sequence[Peer]) -> str:
    """Return the loopback profile of `config/fastdds.xml`, widened to some hosts.

    Its addresses are written down, because Fast DDS takes those of a link that is down
    when a node starts for gone for ever. A list of interfaces would have the same effect.

    Args:
        peers: the hosts, one or more.

    """
    ElementTree.register_namespace('', _NAMESPACE)
    root = ElementTree.parse(config_directory() / FILE).getroot()
    transports = _find(root, 'transport_descriptors')
    loopback = _find(transports, 'transport_descriptor')
    loopback.remove(_find(loopback, 'interfaceWhiteList'))
    if any(peer.address.version == 6 for peer in peers):
        # A copy, but for type and name.
        second = SubElement(transports, _tag('transport_descriptor'))
        for tag, text in (('transport_id', 'ipv6'), ('type', 'UDPv6')):
            SubElement(second, _tag(tag)).text = text
        second.append(_find(loopback, 'maxInitialPeersRange'))
        SubElement(_find(root, 'userTransports'), _tag('transport_id')).text = 'ipv6'
    here = [LOOPBACK, *dict.fromkeys(peer.own for peer in peers)]
    listening = _find(root, 'metatrafficUnicastLocatorList')
    listening.clear()
    _add_locators(listening, here)
    _add_locators(SubElement(_find(root, 'rtps'), _tag('defaultUnicastLocatorList')), here)
    _add_locators(_find(root, 'initialPeersList'), dict.fromkeys(p.address for p in peers))
    return ElementTree.tostring(root, encoding='unicode')


def _add_locators(parent: Element, addresses: Iterable[IPv4Address | IPv6Address]) -> None:
    for address in addresses:
        locator = SubElement(parent, _tag('locator'))
        kind = SubElement(locator, _tag(f'udpv{address.version}'))
        SubElement(kind, _tag('address')).text = str(address)


def _find(root: Element, name: str) -> Element:
    found = root.find(f'.//{_tag(name)}')
    if found is None:
        raise ChoiceError(f'{config_directory() / FILE}: has no {name}')
    return found


def _tag(name: str) -> str:
    return f'{{{_NAMESPACE}}}{name}'
