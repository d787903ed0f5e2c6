# SPDX-License-Identifier: Apache-2.0
import os
from pathlib import Path
import subprocess
import sys

import pytest

from srnn_bringup import cli, supervisor
from srnn_bringup.config import Choices, load
from srnn_bringup.dds_security import enforcement, probe
from srnn_bringup.dds_security.enforcement import lack_of_security, require_security
from srnn_bringup.dds_security.keystore import check_keystore, create_keystore, enclave_folder
from srnn_bringup.environment import domain_id, graph_environment, security_arguments
from srnn_bringup.errors import ChoiceError, KeystoreError, NotReadyError, SecurityError
from srnn_bringup.graph import describe
from srnn_bringup.live_graph import command

LACK = "This Fast DDS version doesn't have the security libraries"
WHEEL = Path(sys.prefix, 'lib', 'librmw_fastrtps_shared_cpp.so')

unprotected = pytest.mark.skipif(
    'LD_PRELOAD' in os.environ or not WHEEL.is_file() or LACK.encode() not in WHEEL.read_bytes(),
    reason='for the middleware of the wheels',
)


@pytest.fixture
def keystore(tmp_path) -> Path:
    create_keystore(tmp_path / 'keystore', domain_id(os.environ))
    return tmp_path / 'keystore'


@pytest.fixture
def nothing_starts(monkeypatch):
    def start(*_):
        raise AssertionError('a node has been started')

    monkeypatch.setattr(supervisor.Supervisor, 'start', start)


def probe_that(monkeypatch, tmp_path, python: str) -> None:
    """Put a script in place of the interpreter that tries out the middleware."""
    script = tmp_path / 'probe'
    script.write_text(f'#!/bin/sh\nexec {sys.executable} -c "{python}"\n')
    script.chmod(0o700)
    monkeypatch.setattr(enforcement.sys, 'executable', str(script))


@unprotected
def test_the_middleware_of_the_wheels_says_itself_what_it_lacks():
    assert lack_of_security(os.environ) == LACK


@unprotected
@pytest.mark.usefixtures('nothing_starts')
@pytest.mark.parametrize('line', ['up', 'demo --segments 1'])
def test_a_middleware_without_security_is_refused_before_anything_starts(keystore, line, capsys):
    assert cli.main([*line.split(), '--secure', str(keystore)]) == 2
    error = capsys.readouterr().err
    assert f'no DDS security ({LACK})' in error
    assert 'srnn key create FILE' in error
    assert 'srnn up --key FILE' in error


@pytest.mark.parametrize(
    ('of_valid', 'of_forged', 'code', 'said'),
    [
        (None, 'permissions are forged', 0, ''),
        ('no plug-ins', 'no plug-ins', 1, 'no plug-ins\n'),
        (None, None, 1, 'it lets in whose permissions are not valid\n'),
        ('no plug-ins', None, 1, 'no plug-ins\n'),
    ],
)
def test_security_is_to_let_in_the_one_and_not_the_other(
    monkeypatch, capsys, of_valid, of_forged, code, said
):
    refusals = {Path('valid'): of_valid, Path('forged'): of_forged}
    monkeypatch.setattr(probe, '_refusal', refusals.get)
    assert probe.main(['valid', 'forged']) == code
    assert capsys.readouterr().out == said


@pytest.mark.usefixtures('nothing_starts')
def test_an_incomplete_keystore_is_refused_before_anything_starts(keystore, capsys):
    missing = enclave_folder(keystore, 'tracker') / 'key.pem'
    missing.unlink()
    assert cli.main(['up', '--secure', str(keystore)]) == 2
    assert f'{missing} is missing' in capsys.readouterr().err


def test_a_keystore_that_is_not_there_is_a_mistake(capsys):
    with pytest.raises(SystemExit) as end:
        cli.main(['up', '--secure', '/nowhere'])
    assert end.value.code == 2
    assert "'/nowhere': there is no such directory" in capsys.readouterr().err


def test_a_keystore_for_another_domain_is_refused(keystore):
    with pytest.raises(KeystoreError, match='ROS_DOMAIN_ID = 232'):
        require_security(keystore, {**os.environ, 'ROS_DOMAIN_ID': '232'})


def test_one_identity_for_all_is_refused(keystore):
    environ = {**os.environ, 'ROS_SECURITY_ENCLAVE_OVERRIDE': '/mine'}
    with pytest.raises(ChoiceError, match="ROS_SECURITY_ENCLAVE_OVERRIDE = '/mine'"):
        require_security(keystore, environ)


@pytest.mark.parametrize(
    ('python', 'lack'),
    [
        ('pass', ''),
        ("import sys; print('it has none'); sys.exit(1)", 'it has none'),
        ("import sys; sys.exit('broken')", 'broken'),
        ('import os; os.abort()', 'exit code -6'),
    ],
)
def test_what_the_trial_found_is_reported(monkeypatch, tmp_path, keystore, python, lack):
    probe_that(monkeypatch, tmp_path, python)
    assert lack_of_security(os.environ) == lack
    if not lack:
        require_security(keystore, os.environ)
        return
    with pytest.raises(SecurityError, match=lack):
        require_security(keystore, os.environ)


def test_a_trial_that_hangs_tells_nothing(monkeypatch, tmp_path):
    probe_that(monkeypatch, tmp_path, 'import time; time.sleep(60)')
    monkeypatch.setattr(enforcement, 'TRY_S', 0.2)
    with pytest.raises(NotReadyError, match=r'within 0.2 s'):
        lack_of_security(os.environ)


def test_the_trial_compares_a_valid_keystore_with_one_whose_permissions_are_forged(monkeypatch):
    verified = []

    def run(line, **_):
        for keystore in map(Path, line[-2:]):
            check_keystore(keystore, domain_id(os.environ))
            folder = enclave_folder(keystore, 'srnn')
            check = ['openssl', 'smime', '-verify', '-in', folder / 'permissions.p7s']
            check += ['-CAfile', folder / 'permissions_ca.cert.pem']
            verified.append(run_process(check, capture_output=True).returncode == 0)
        return subprocess.CompletedProcess(line, 0)

    run_process = subprocess.run
    monkeypatch.setattr(enforcement.subprocess, 'run', run)
    assert not lack_of_security(os.environ)
    assert verified == [True, False]


def test_every_process_is_in_its_enclave_and_takes_part_only_if_protected(keystore):
    configuration = load(Choices(keystore=keystore))
    assert configuration.keystore == keystore
    for description in describe(configuration):
        process = command(description, Path('p.yaml'), keystore=configuration.keystore)
        line = ' '.join(process.arguments)
        assert f'--ros-args --enclave /srnn/{description.name}' in line
        assert process.environment['ROS_SECURITY_KEYSTORE'] == str(keystore)
        assert process.environment['ROS_SECURITY_ENABLE'] == 'true'
        assert process.environment['ROS_SECURITY_STRATEGY'] == 'Enforce'


def test_a_keystore_protects_no_namespace_but_the_root(keystore):
    with pytest.raises(ChoiceError, match="namespace '/left': a keystore gives rights"):
        load(Choices(keystore=keystore, namespace='/left'))


def test_without_a_keystore_nothing_changes():
    assert security_arguments('tracker', None) == []
    assert not [name for name in graph_environment({}) if name.startswith('ROS_SECURITY')]
