# SPDX-License-Identifier: Apache-2.0
from xml.etree import ElementTree

import pytest

from srnn_bringup import doctor, security
from srnn_bringup.config_lookup import config_directory
from srnn_bringup.doctor import Finding, Verdict, examine, run_doctor
from srnn_bringup.errors import NotReadyError


@pytest.fixture(autouse=True)
def trial(monkeypatch):
    """Trying out the middleware takes seconds; let it have nothing to say."""
    monkeypatch.setattr(security, 'lack_of_security', lambda environ: '')


def findings(environ):
    return {finding.subject: finding for finding in examine(environ)}


def test_nothing_is_missing_where_the_tests_run():
    found = findings({})
    assert not [f for f in found.values() if f.verdict is Verdict.MISSING]
    assert set(doctor.NEEDED) <= set(found)
    assert 'four_waypoints' in found['configuration'].words


@pytest.mark.parametrize(
    ('environ', 'verdict', 'words'),
    [
        ({}, Verdict.OK, 'loopback'),
        ({'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}, Verdict.OK, 'loopback'),
        ({'ROS_AUTOMATIC_DISCOVERY_RANGE': 'OFF'}, Verdict.OK, 'OFF'),
        ({'FASTDDS_BUILTIN_TRANSPORTS': 'SHM'}, Verdict.OK, 'LOCALHOST'),
        ({'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET'}, Verdict.NOTE, 'other hosts'),
    ],
)
def test_being_open_to_other_hosts_is_noted(environ, verdict, words):
    found = findings(environ)['discovery']
    assert found.verdict is verdict
    assert words in found.words


def test_untested_middleware_is_noted():
    found = findings({'RMW_IMPLEMENTATION': 'rmw_other'})['RMW_IMPLEMENTATION']
    assert found.verdict is Verdict.NOTE


def test_a_receive_queue_that_is_too_short_is_noted(tmp_path, monkeypatch):
    profile = ElementTree.parse(config_directory() / 'fastdds.xml')
    (asked,) = [e.text for e in profile.iter() if e.tag.endswith('receiveBufferSize')]
    assert int(asked) == doctor.RECEIVE_QUEUE
    monkeypatch.setattr(doctor, '_RECEIVE_MAX', tmp_path / 'rmem_max')
    for allowed, verdict in ((212992, Verdict.NOTE), (doctor.RECEIVE_QUEUE, Verdict.OK)):
        (tmp_path / 'rmem_max').write_text(f'{allowed}\n')
        found = findings({})['receive queue']
        assert found.verdict is verdict
    assert 'sysctl' not in found.words


def test_dds_security_is_available_where_nothing_is_lacking():
    found = findings({})['DDS security']
    assert found.verdict is Verdict.OK
    assert '--secure' in found.words


@pytest.mark.parametrize('raises', [False, True])
def test_without_dds_security_the_way_out_is_named(monkeypatch, raises):
    def trial(environ):
        if raises:
            raise NotReadyError('no plug-ins')
        return 'no plug-ins'

    monkeypatch.setattr(security, 'lack_of_security', trial)
    found = findings({})['DDS security']
    assert found.verdict is Verdict.NOTE
    assert 'no plug-ins' in found.words
    assert '--key' in found.words


def test_a_package_that_is_not_there_is_missing(monkeypatch):
    monkeypatch.setattr(doctor, 'NEEDED', ('numpy', 'no_such_package'))
    found = findings({})
    assert found['numpy'].verdict is Verdict.OK
    assert found['no_such_package'].verdict is Verdict.MISSING


@pytest.mark.parametrize(
    ('verdict', 'code'), [(Verdict.OK, 0), (Verdict.NOTE, 0), (Verdict.MISSING, 1)]
)
def test_only_what_is_missing_is_a_failure(monkeypatch, verdict, code):
    monkeypatch.setattr(doctor, 'examine', lambda: [Finding('thing', verdict, 'words')])
    said = []
    assert run_doctor(said.append) == code
    assert verdict.value in said[0]
