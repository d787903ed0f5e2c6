# SPDX-License-Identifier: Apache-2.0
from ipaddress import ip_address
import os
from pathlib import Path
import socket
from xml.etree import ElementTree

import pytest

from srnn_bringup.environment import DISCOVERY_RANGE, MIDDLEWARE, PROFILES, graph_environment
from srnn_bringup.errors import ChoiceError
from srnn_bringup.peer_profile import PARTICIPANTS, peer_profile, talking_to
from srnn_bringup.peers import Peer, find_peer

ARM = Peer(ip_address('10.0.0.1'), ip_address('10.0.0.9'))
EYE = Peer(ip_address('10.0.0.2'), ip_address('10.0.0.9'))
SIX = Peer(ip_address('fd00::1'), ip_address('fd00::9'))


@pytest.fixture
def network(monkeypatch):
    """Stands for a network with one host in it, that has a name."""

    class Probe:
        def __init__(self, family, kind):
            self._family = family

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

        def connect(self, where):
            if where[0] not in ('10.0.0.1', '10.0.0.9', 'fd00::1'):
                raise OSError(101, 'Network is unreachable')
            self._to = where[0]

        def getsockname(self):
            return ('fd00::9' if ':' in self._to else '10.0.0.9', 1)

    def look_up(name, *_, **__):
        if name != 'arm':
            raise socket.gaierror(-2, 'Name or service not known')
        found = ((socket.AF_INET6, 'fd00::1'), (socket.AF_INET, '10.0.0.1'))
        return [(family, 0, 0, '', (address, 0)) for family, address in found]

    monkeypatch.setattr(socket, 'socket', Probe)
    monkeypatch.setattr(socket, 'getaddrinfo', look_up)


@pytest.mark.parametrize(
    ('text', 'peer'), [('10.0.0.1', ARM), ('arm', ARM), ('fd00::1', SIX)]
)
def test_a_host_is_found_by_address_or_name(network, text, peer):
    assert find_peer(text) == peer


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('amr', "'amr': must be an IPv4 or IPv6 address, or the name of a host: Name or service"),
        ('', 'must be an IPv4 or IPv6 address'),
        ('10.0.0.300', 'must be an IPv4 or IPv6 address'),
        ('10.0.0.9', 'is this host itself'),
        ('10.9.9.9', 'no way leads there: Network is unreachable'),
        ('0.0.0.0', 'must be the address of one host'),
        ('239.255.0.1', 'must be the address of one host'),
        ('255.255.255.255', 'must be the address of one host'),
        ('fe80::1', 'is link-local'),
    ],
)
def test_what_is_no_other_host_is_refused(network, text, words):
    with pytest.raises(ChoiceError) as caught:
        find_peer(text)
    assert words in str(caught.value)


def locators(profile: str, name: str) -> list[tuple[str, str | None]]:
    """Return address and port of every locator in a list of a profile."""
    root = ElementTree.fromstring(profile)
    (found,) = root.iter(f'{{http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles}}{name}')
    kinds = [kind for locator in found for kind in locator]
    parts = [{part.tag.rpartition('}')[2]: part.text for part in kind} for kind in kinds]
    return [(part['address'], part.get('port')) for part in parts]


@pytest.mark.parametrize(
    ('peers', 'loopback', 'own'),
    [((ARM, EYE), '127.0.0.1', '10.0.0.9'), ((SIX,), '::1', 'fd00::9')],
)
def test_the_graph_talks_to_this_host_and_the_named_ones(peers, loopback, own):
    profile = peer_profile(peers, 3)
    for name in ('metatrafficUnicastLocatorList', 'defaultUnicastLocatorList'):
        assert locators(profile, name) == [(loopback, None), (own, None)]
    here, *others = locators(profile, 'initialPeersList')
    assert here == (loopback, None)
    assert set(others) == {
        (str(peer.address), str(7400 + 250 * 3 + 10 + 2 * k))
        for peer in peers for k in range(PARTICIPANTS)
    }  # fmt: skip
    assert 'interfaceWhiteList' not in profile


def test_addresses_of_both_versions_do_not_go_together():
    with pytest.raises(ChoiceError, match='all hosts by IPv4, or all by IPv6'):
        peer_profile([ARM, SIX], 0)


def test_processes_find_the_profile_as_long_as_it_is_wanted(monkeypatch):
    monkeypatch.setenv(DISCOVERY_RANGE, 'LOCALHOST')
    monkeypatch.delenv(PROFILES, raising=False)
    before = dict(os.environ)
    with talking_to([]):
        assert dict(os.environ) == before
    with talking_to([ARM]):
        chosen = graph_environment(os.environ)
        assert chosen[DISCOVERY_RANGE] == 'SYSTEM_DEFAULT'
        file = Path(chosen[PROFILES])
        assert '10.0.0.1' in file.read_text()
    assert dict(os.environ) == before
    assert not file.exists()


@pytest.mark.parametrize(
    'variable', [(DISCOVERY_RANGE, 'SUBNET'), (PROFILES, 'mine.xml'), (MIDDLEWARE, 'rmw_other')]
)
def test_peers_and_a_middleware_of_ones_own_do_not_go_together(monkeypatch, variable):
    monkeypatch.setenv(*variable)
    with pytest.raises(ChoiceError, match='--peer is for the middleware as it comes'), talking_to(
        [ARM]
    ):
        pass
