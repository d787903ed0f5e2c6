# SPDX-License-Identifier: Apache-2.0
import json
import os
from pathlib import Path
import socket
import tempfile
from xml.etree import ElementTree

import pytest

import lwr_tracking
from srnn_bringup import cli
from srnn_bringup.config_lookup import config_directory
from srnn_bringup.dds_security import enforcement
from srnn_bringup.doctor import examination, machine, middleware, probes, software
from srnn_bringup.doctor.examination import examine, run_doctor
from srnn_bringup.doctor.finding import Finding, Verdict
from srnn_bringup.doctor.imports import refusals
from srnn_bringup.doctor.messages import Heard
from srnn_bringup.errors import NotReadyError


@pytest.fixture(autouse=True)
def trial(monkeypatch):
    """Trying out imports and the middleware takes seconds; let them have nothing to say."""
    monkeypatch.setattr(software, 'refusals', lambda names, environ: {})
    monkeypatch.setattr(enforcement, 'lack_of_security', lambda environ: '')
    monkeypatch.setattr(middleware, 'exchange', lambda environ: Heard('', 0.1, 'rmw', ()))


def findings(environ):
    return {finding.subject: finding for finding in examine(environ)}


def test_nothing_is_missing_where_the_tests_run(monkeypatch):
    monkeypatch.setattr(software, 'refusals', refusals)
    found = findings(os.environ)
    assert not [f for f in found.values() if f.verdict is Verdict.FAIL]
    assert set(software.NEEDED) <= set(found)
    assert 'four_waypoints' in found['configuration'].words


@pytest.mark.parametrize(
    ('environ', 'verdict', 'words'),
    [
        ({}, Verdict.OK, 'loopback'),
        ({'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}, Verdict.OK, 'loopback'),
        ({'ROS_AUTOMATIC_DISCOVERY_RANGE': 'OFF'}, Verdict.OK, 'OFF'),
        ({'FASTDDS_BUILTIN_TRANSPORTS': 'SHM'}, Verdict.OK, 'LOCALHOST'),
        ({'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET'}, Verdict.WARN, 'other hosts'),
    ],
)
def test_being_open_to_other_hosts_is_noted(environ, verdict, words):
    found = findings(environ)['discovery']
    assert found.verdict is verdict
    assert words in found.words


def test_untested_middleware_is_noted():
    found = findings({'RMW_IMPLEMENTATION': 'rmw_other'})['RMW_IMPLEMENTATION']
    assert found.verdict is Verdict.WARN


def test_a_receive_queue_that_is_too_short_is_noted(tmp_path, monkeypatch):
    profile = ElementTree.parse(config_directory() / 'fastdds.xml')
    (asked,) = [e.text for e in profile.iter() if e.tag.endswith('receiveBufferSize')]
    assert int(asked) == middleware.RECEIVE_QUEUE
    monkeypatch.setattr(probes, '_RECEIVE_MAX', tmp_path / 'rmem_max')
    for allowed, verdict in ((212992, Verdict.WARN), (middleware.RECEIVE_QUEUE, Verdict.OK)):
        (tmp_path / 'rmem_max').write_text(f'{allowed}\n')
        found = findings({})['receive queue']
        assert found.verdict is verdict
        assert ('sysctl' in found.advice) == (verdict is Verdict.WARN)


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

    monkeypatch.setattr(enforcement, 'lack_of_security', trial)
    found = findings({})['DDS security']
    assert found.verdict is Verdict.WARN
    assert 'no plug-ins' in found.words
    assert '--key' in found.advice


def test_a_package_that_is_not_there_is_missing(monkeypatch):
    monkeypatch.setattr(software, 'refusals', refusals)
    monkeypatch.setattr(software, 'NEEDED', ('numpy', 'no_such_package'))
    found = findings(os.environ)
    assert found['numpy'].verdict is Verdict.OK
    assert found['no_such_package'].verdict is Verdict.FAIL


def test_a_package_that_ends_its_process_does_not_end_the_doctor(tmp_path):
    (tmp_path / 'deadly.py').write_text('import os\nos.write(2, b"no such rmw\\n")\nos._exit(102)')
    (tmp_path / 'silent.py').write_text('import os\nos._exit(7)')
    path = f'{tmp_path}:{os.environ.get("PYTHONPATH", "")}'
    found = refusals(('json', 'deadly', 'silent', 'csv'), {**os.environ, 'PYTHONPATH': path})
    assert found == {'deadly': 'no such rmw', 'silent': 'ends the process with code 7'}


@pytest.mark.parametrize(
    ('verdict', 'code'), [(Verdict.OK, 0), (Verdict.WARN, 0), (Verdict.FAIL, 1)]
)
def test_only_what_is_missing_is_a_failure(monkeypatch, verdict, code):
    monkeypatch.setattr(examination, 'examine', lambda: [Finding('thing', verdict, 'words')])
    said = []
    assert run_doctor(said.append)[0] == code
    assert verdict.value in said[0]


NOT_WRITABLE = Path('/not/writable')


def refused(*places):
    """Return a probe by which none of these places can be written to."""
    return lambda directory: not any(directory.is_relative_to(place) for place in places)


@pytest.mark.parametrize(
    ('probe', 'answer', 'subject', 'verdict', 'advice'),
    [
        ('real_time_refusal', 'Operation not permitted', 'real-time priority', 'WARN', 'rtprio'),
        ('real_time_refusal', '', 'real-time priority', 'OK', ''),
        ('lockable_bytes', 65536, 'locked memory', 'WARN', 'memlock unlimited'),
        ('lockable_bytes', None, 'locked memory', 'OK', ''),
        ('cpus', 1, 'processors', 'WARN', 'taskset'),
        ('cpus', 4, 'processors', 'OK', ''),
        ('load', 1000.0, 'load', 'WARN', 'end what else runs'),
        ('load', 0.0, 'load', 'OK', ''),
        ('clock_is_kept', False, 'clock', 'WARN', 'chronyd'),
        ('clock_is_kept', True, 'clock', 'OK', ''),
        ('free_bytes', 0, 'disk', 'FAIL', 'make room'),
        ('free_bytes', 512 << 20, 'disk', 'WARN', 'make room'),
        ('free_bytes', 1 << 40, 'disk', 'OK', ''),
        ('drawing_failure', 'ImportError: no Agg', 'rendering', 'WARN', 'install'),
        ('drawing_failure', '', 'rendering', 'OK', ''),
        ('port_refusal', 'Address already in use', 'port of FRI', 'WARN', 'ss -lunp'),
        ('port_refusal', 'Address already in use', 'port of the view', 'WARN', '--view PORT'),
        ('port_refusal', '', 'port of FRI', 'OK', ''),
        ('receive_queue_bytes', 4096, 'receive queue', 'WARN', 'sysctl'),
    ],
)
def test_what_a_probe_finds_is_judged_and_helped(
    probe, answer, subject, verdict, advice, monkeypatch
):
    monkeypatch.setattr(probes, probe, lambda *arguments: answer)
    found = findings({})[subject]
    assert found.verdict.value == verdict
    assert advice in found.advice
    assert bool(found.advice) == (verdict != 'OK')


@pytest.mark.parametrize('found', [(), ('EGL',), ('EGL', 'OSMesa')])
def test_what_could_render_is_told(found, monkeypatch):
    monkeypatch.setattr(probes, 'gl_libraries', lambda: found)
    assert (', '.join(found) or 'none') in findings({})['rendering'].words


@pytest.mark.parametrize(
    ('environ', 'subject', 'verdict', 'advice'),
    [
        ({'NUMBA_CACHE_DIR': '/not/writable/numba'}, 'numba cache', 'FAIL', 'NUMBA_CACHE_DIR'),
        ({'MPLCONFIGDIR': '/not/writable/mpl'}, 'matplotlib cache', 'WARN', 'MPLCONFIGDIR'),
        ({'ROS_LOG_DIR': '/not/writable/log'}, 'ROS log', 'WARN', 'ROS_LOG_DIR'),
        ({'ROS_HOME': '/not/writable'}, 'ROS log', 'WARN', 'ROS_LOG_DIR'),
    ],
)
def test_a_cache_that_cannot_be_written_is_found(environ, subject, verdict, advice, monkeypatch):
    monkeypatch.setattr(probes, 'writable', refused(NOT_WRITABLE))
    found = findings(environ)[subject]
    assert (found.verdict.value, '/not/writable' in found.words) == (verdict, True)
    assert advice in found.advice


def test_compiled_code_is_kept_in_the_home_where_the_packages_are_read_only(monkeypatch):
    # Installed by colcon, every package has a place of its own; this one has kernels.
    packages = Path(machine.__file__).parents[3], Path(lwr_tracking.__file__).parent
    monkeypatch.setattr(probes, 'writable', refused(*packages))
    found = findings({'HOME': '/home/me'})['numba cache']
    assert (found.verdict, found.words) == (Verdict.OK, '/home/me/.cache/numba')


def test_without_room_for_parameters_nothing_works(monkeypatch):
    monkeypatch.setattr(probes, 'writable', refused(Path(tempfile.gettempdir())))
    found = findings({})['disk for parameters']
    assert (found.verdict, 'TMPDIR' in found.advice) == (Verdict.FAIL, True)


def test_a_message_that_does_not_arrive_is_a_failure(monkeypatch):
    monkeypatch.setattr(middleware, 'exchange', lambda environ: Heard('nothing arrives'))
    found = findings({})['messages']
    assert (found.verdict, found.words) == (Verdict.FAIL, 'nothing arrives')
    assert 'firewall' in found.advice


@pytest.mark.parametrize(
    ('others', 'verdict', 'words'),
    [
        ((), Verdict.OK, '7; no others'),
        (('talker',), Verdict.WARN, '7 is in use: talker'),
        (('planner', 'rviz'), Verdict.WARN, '7 is in use, a graph of srnn among them: planner'),
    ],
)
def test_others_in_the_domain_are_named(others, verdict, words, monkeypatch):
    monkeypatch.setattr(middleware, 'exchange', lambda environ: Heard('', 0.1, 'rmw', others))
    found = findings({'ROS_DOMAIN_ID': '7'})['ROS_DOMAIN_ID']
    assert (found.verdict, words in found.words) == (verdict, True)
    assert ('export ROS_DOMAIN_ID' in found.advice) == bool(others)


def test_an_impossible_domain_is_not_tried_out(monkeypatch):
    monkeypatch.setattr(middleware, 'exchange', not_reached)
    found = findings({'ROS_DOMAIN_ID': '233'})['environment']
    assert (found.verdict, 'must be 0 to 232' in found.words) == (Verdict.FAIL, True)


def not_reached(environ):
    raise AssertionError('tried in spite of a mistake')


def test_other_versions_than_the_tested_ones_are_named(tmp_path):
    lock = tmp_path / 'requirements.lock'
    lock.write_text(f'# pinned\nnumpy=={software.installed("numpy")}\n')
    assert software.versions(lock).verdict is Verdict.OK
    lock.write_text('numpy==0.1\nno-such-thing==2\n')
    found = software.versions(lock)
    assert found.verdict is Verdict.WARN
    assert 'instead of 0.1, no-such-thing missing instead of 2' in found.words
    assert 'make setup' in found.advice
    assert software.versions(tmp_path / 'none').verdict is Verdict.OK


def test_probes_tell_of_a_port_in_use_and_a_directory_that_cannot_be(tmp_path):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as owner:
        owner.bind(('', 0))
        port = owner.getsockname()[1]
        assert probes.port_refusal(socket.SOCK_DGRAM, port)
    assert not probes.port_refusal(socket.SOCK_DGRAM, port)
    (tmp_path / 'file').touch()
    assert probes.writable(tmp_path / 'to be' / 'made')
    assert not probes.writable(tmp_path / 'file' / 'inside')
    assert not probes.writable(Path('/proc/nowhere'))


def test_findings_are_told_to_machines_alone_on_standard_output(monkeypatch, capsys):
    bad = [Finding('thing', Verdict.FAIL, 'broken', 'mend it'), Finding('x', Verdict.OK, 'fine')]
    monkeypatch.setattr(examination, 'examine', lambda: bad)
    assert cli.main(['doctor', '--json', '-']) == 1
    shown = capsys.readouterr()
    assert json.loads(shown.out) == {
        'ok': False,
        'findings': [
            {'subject': 'thing', 'verdict': 'FAIL', 'found': 'broken', 'advice': 'mend it'},
            {'subject': 'x', 'verdict': 'OK', 'found': 'fine', 'advice': ''},
        ],
    }
    assert 'broken; to do: mend it' in shown.err
    assert cli.main(['doctor', '--quiet']) == 1
    assert capsys.readouterr() == ('', '')
