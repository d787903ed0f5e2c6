# SPDX-License-Identifier: Apache-2.0
import os
from pathlib import Path
import re
import shutil
import stat
import subprocess

from cryptography import x509
from cryptography.hazmat.primitives import serialization
from cryptography.hazmat.primitives.asymmetric import ec
import pytest

from srnn_bringup import cli
from srnn_bringup.dds_security import keystore
from srnn_bringup.dds_security.enclaves import MEMBERS, enclave
from srnn_bringup.dds_security.keystore import (
    FILES,
    check_keystore,
    create_keystore,
    enclave_folder,
)
from srnn_bringup.errors import KeystoreError

DOMAIN = 17

members = pytest.mark.parametrize('member', MEMBERS)


@pytest.fixture(scope='module')
def made(tmp_path_factory) -> Path:
    directory = tmp_path_factory.mktemp('made') / 'keystore'
    create_keystore(directory, DOMAIN)
    return directory


@pytest.fixture
def copy(made, tmp_path) -> Path:
    return Path(shutil.copytree(made, tmp_path / 'copy', symlinks=True))


def certificate(path: Path) -> x509.Certificate:
    return x509.load_pem_x509_certificate(path.read_bytes())


def common_name(name: x509.Name) -> str:
    (attribute,) = name.get_attributes_for_oid(x509.oid.NameOID.COMMON_NAME)
    return str(attribute.value)


def openssl(*arguments: object) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(['openssl', *map(str, arguments)], capture_output=True, timeout=60)


def verified(signed: Path, authority: Path) -> bytes:
    """Return the text that the authority has signed, without what MIME does to it."""
    done = openssl('smime', '-verify', '-text', '-in', signed, '-CAfile', authority)
    assert done.returncode == 0, done.stderr
    return done.stdout.replace(b'\r\n', b'\n')


def content(directory: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in directory.rglob('*') if path.is_file()}


def test_the_layout_is_that_of_ros2_security(made):
    enclaves = {f'enclaves{enclave(member)}/{name}' for member in MEMBERS for name in FILES}
    assert {str(path.relative_to(made)) for path in content(made)} == enclaves | {
        'enclaves/governance.p7s', 'enclaves/governance.xml',
        'private/identity_ca.key.pem', 'private/permissions_ca.key.pem',
        'public/identity_ca.cert.pem', 'public/permissions_ca.cert.pem',
    }  # fmt: skip


def test_only_the_owner_can_read_it(made):
    for path in (made, *made.rglob('*')):
        expected = 0o700 if path.is_dir() else 0o600
        assert stat.S_IMODE(path.stat().st_mode) == expected, path


def test_links_lead_to_where_the_keystore_is_moved(made, tmp_path):
    moved = Path(shutil.copytree(made, tmp_path / 'moved', symlinks=True))
    links = [path for path in moved.rglob('*') if path.is_symlink()]
    assert len(links) == 3 * len(MEMBERS)
    assert all(path.resolve().is_relative_to(moved) for path in links)


@members
def test_the_authority_certifies_the_enclave_by_its_name(made, member):
    folder = enclave_folder(made, member)
    ours, authority = certificate(folder / 'cert.pem'), folder / 'identity_ca.cert.pem'
    ours.verify_directly_issued_by(certificate(authority))
    assert common_name(ours.subject) == enclave(member)
    done = openssl('verify', '-x509_strict', '-CAfile', authority, folder / 'cert.pem')
    assert done.returncode == 0, done.stderr


@members
def test_the_key_fits_the_certificate_and_belongs_to_nobody_else(made, member):
    key = serialization.load_pem_private_key(
        (enclave_folder(made, member) / 'key.pem').read_bytes(), None
    )
    assert isinstance(key.curve, ec.SECP256R1)
    fits = [
        other for other in MEMBERS
        if certificate(enclave_folder(made, other) / 'cert.pem').public_key() == key.public_key()
    ]  # fmt: skip
    assert fits == [member]


def test_an_enclave_is_no_authority(made):
    for member in MEMBERS:
        extensions = certificate(enclave_folder(made, member) / 'cert.pem').extensions
        assert not extensions.get_extension_for_class(x509.BasicConstraints).value.ca


@members
def test_permissions_are_signed_by_the_authority(made, member):
    folder = enclave_folder(made, member)
    text = verified(folder / 'permissions.p7s', folder / 'permissions_ca.cert.pem')
    assert text == (folder / 'permissions.xml').read_bytes()
    assert f'<subject_name>CN={enclave(member)}</subject_name>'.encode() in text


@members
def test_the_governance_is_signed_by_the_authority(made, member):
    folder = enclave_folder(made, member)
    text = verified(folder / 'governance.p7s', folder / 'permissions_ca.cert.pem')
    assert text == (made / 'enclaves' / 'governance.xml').read_bytes()


def test_a_changed_permission_or_another_authority_does_not_verify(copy, tmp_path):
    create_keystore(tmp_path / 'theirs', DOMAIN)
    folder = enclave_folder(copy, 'planner')
    signed, authority = folder / 'permissions.p7s', folder / 'permissions_ca.cert.pem'
    theirs = tmp_path / 'theirs' / 'public' / 'permissions_ca.cert.pem'
    assert openssl('smime', '-verify', '-in', signed, '-CAfile', authority).returncode == 0
    assert openssl('smime', '-verify', '-in', signed, '-CAfile', theirs).returncode != 0
    signed.write_bytes(signed.read_bytes().replace(b'rt/segment<', b'rt/*<'))
    assert openssl('smime', '-verify', '-in', signed, '-CAfile', authority).returncode != 0


def test_an_enclave_cannot_sign_permissions_of_its_own(made, tmp_path):
    folder = enclave_folder(made, 'planner')
    signed, authority = tmp_path / 'signed', folder / 'permissions_ca.cert.pem'
    done = openssl(
        'smime', '-sign', '-text', '-in', folder / 'permissions.xml', '-out', signed,
        '-signer', folder / 'cert.pem', '-inkey', folder / 'key.pem',
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    identity = folder / 'identity_ca.cert.pem'
    assert openssl('smime', '-verify', '-in', signed, '-CAfile', identity).returncode == 0
    assert openssl('smime', '-verify', '-in', signed, '-CAfile', authority).returncode != 0


@pytest.mark.parametrize('there', ['file', 'directory with something in it', 'keystore'])
def test_what_is_there_already_is_left_as_it_is(tmp_path, there):
    place = tmp_path / 'place'
    if there == 'keystore':
        create_keystore(place, DOMAIN)
    elif there == 'file':
        place.write_text('mine')
    else:
        place.mkdir()
        (place / 'note').write_text('mine')
    before = content(tmp_path)
    with pytest.raises(KeystoreError, match='is there already'):
        create_keystore(place, DOMAIN)
    assert content(tmp_path) == before
    assert list(tmp_path.iterdir()) == [place]


def test_an_empty_directory_will_do(tmp_path):
    (tmp_path / 'empty').mkdir()
    create_keystore(tmp_path / 'empty', DOMAIN)
    check_keystore(tmp_path / 'empty', DOMAIN)


def test_what_appears_meanwhile_is_left_as_it_is(tmp_path, monkeypatch):
    place, fill = tmp_path / 'place', keystore._fill

    def fill_slowly(draft, domain):
        fill(draft, domain)
        create_note(place)

    def create_note(folder):
        folder.mkdir()
        (folder / 'note').write_text('mine')

    monkeypatch.setattr(keystore, '_fill', fill_slowly)
    with pytest.raises(OSError, match='not empty'):
        create_keystore(place, DOMAIN)
    assert content(tmp_path) == {place / 'note': b'mine'}


@pytest.mark.parametrize('number', range(5))
@pytest.mark.parametrize('error', [OSError('disk full'), KeyboardInterrupt()])
def test_a_failure_leaves_nothing(tmp_path, monkeypatch, error, number):
    write, calls = keystore._write, iter(range(100))

    def break_down(path, text):
        if next(calls) == 4 * number:
            raise error
        write(path, text)

    monkeypatch.setattr(keystore, '_write', break_down)
    with pytest.raises(type(error)):
        create_keystore(tmp_path / 'keystore', DOMAIN)
    assert not list(tmp_path.iterdir())


def test_a_place_that_is_not_there_is_named(tmp_path):
    with pytest.raises(KeystoreError, match=re.escape(f'no directory {tmp_path / "nowhere"}')):
        create_keystore(tmp_path / 'nowhere' / 'keystore', DOMAIN)


@pytest.mark.parametrize('name', FILES)
@members
def test_a_missing_file_is_named(copy, member, name):
    check_keystore(copy, DOMAIN)
    missing = enclave_folder(copy, member) / name
    missing.unlink()
    with pytest.raises(KeystoreError, match=re.escape(f'{missing} is missing')):
        check_keystore(copy, DOMAIN)


def test_a_link_to_nowhere_is_a_missing_file(copy):
    (copy / 'public' / 'identity_ca.cert.pem').unlink()
    with pytest.raises(KeystoreError, match=r'identity_ca.cert.pem is missing'):
        check_keystore(copy, DOMAIN)


def test_the_keys_of_the_authority_may_be_elsewhere(copy):
    shutil.rmtree(copy / 'private')
    check_keystore(copy, DOMAIN)


def test_another_domain_is_refused(made):
    with pytest.raises(KeystoreError, match='ROS_DOMAIN_ID = 18: .* is for 17'):
        check_keystore(made, DOMAIN + 1)


def test_the_command_says_what_it_made_and_what_comes_next(tmp_path, capsys, monkeypatch):
    monkeypatch.setenv('ROS_DOMAIN_ID', '99')
    directory = tmp_path / 'keystore'
    assert cli.main(['keystore', 'create', str(directory)]) == 0
    check_keystore(directory, 99)
    said = capsys.readouterr().out
    assert 'ROS_DOMAIN_ID = 99' in said
    assert all(enclave(member) in said for member in MEMBERS)
    assert f'next: srnn up --secure {directory}' in said
    before = content(directory)
    assert cli.main(['keystore', 'create', str(directory)]) == 2
    assert 'is there already' in capsys.readouterr().err
    assert content(directory) == before


def test_a_mask_of_the_user_does_not_open_it(tmp_path):
    mask = os.umask(0)
    try:
        create_keystore(tmp_path / 'keystore', DOMAIN)
    finally:
        os.umask(mask)
    test_only_the_owner_can_read_it(tmp_path / 'keystore')
