# SPDX-License-Identifier: Apache-2.0
from contextlib import suppress
import os
import subprocess
import sys

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
import pytest

from srnn_access import AccessError, Key
from srnn_access.errors import (
    KeyFileClosedError,
    KeyFileError,
    KeyFileExistsError,
    KeyFileMissingError,
)
from srnn_access.key_file import create, load

LOAD = 'import sys; from srnn_access.key_file import load; load(sys.argv[1])'


@pytest.fixture
def path(tmp_path):
    return tmp_path / 'graph.key'


def write(path, text, mode=0o600):
    path.write_bytes(text)
    path.chmod(mode)


@pytest.mark.parametrize('umask', [0o000, 0o022, 0o377])
def test_a_new_key_comes_back_and_only_its_owner_can_read_it(path, umask):
    before = os.umask(umask)
    try:
        key = create(path)
    finally:
        os.umask(before)
    assert path.stat().st_mode & 0o777 == 0o600
    assert load(path).secret == key.secret
    assert len(key.secret) == 32


def test_no_two_keys_are_the_same(tmp_path):
    keys = [create(tmp_path / str(n)) for n in range(20)]
    assert len({key.secret for key in keys}) == len({key.fingerprint for key in keys}) == 20


def test_no_file_is_ever_overwritten(path):
    key = create(path)
    with pytest.raises(KeyFileExistsError, match='exists already: it is never overwritten'):
        create(path)
    assert load(path).secret == key.secret


@pytest.mark.parametrize('mode', [0o640, 0o604, 0o620, 0o602, 0o610, 0o601, 0o660, 0o777])
def test_a_file_that_others_can_use_is_refused(path, mode):
    create(path)
    path.chmod(mode)
    with pytest.raises(KeyFileError, match=rf'mode {mode:04o}.*must be 0600 \(chmod 600\)'):
        load(path)


@pytest.mark.parametrize(
    'text',
    [
        b'', b'\n', b'0' * 63, b'0' * 65, b'0' * 64 + b'\n\n', b' ' + b'0' * 63, b'A' * 64,
        b'g' * 64, b'\xff' * 64, b'0' * 10_000,
    ],
)  # fmt: skip
def test_a_file_without_a_key_is_refused(path, text):
    write(path, text)
    with pytest.raises(KeyFileError, match='holds no key: must be 64 hex digits'):
        load(path)


def test_a_key_without_the_end_of_the_line_is_a_key(path):
    write(path, b'0f' * 32)
    assert load(path).secret == b'\x0f' * 32


def test_a_missing_file_says_how_to_make_one(path):
    with pytest.raises(KeyFileMissingError, match='no such file; srnn key create makes one'):
        load(path)


def test_what_is_no_file_is_refused_without_waiting(tmp_path):
    pipe = tmp_path / 'pipe'
    os.mkfifo(pipe, 0o600)
    done = subprocess.run(
        [sys.executable, '-c', LOAD, pipe], capture_output=True, text=True, timeout=20
    )
    assert 'must be a regular file' in done.stderr
    with pytest.raises(KeyFileError, match='must be a regular file'):
        load(tmp_path)


def test_a_key_that_cannot_be_written_says_why(tmp_path):
    with pytest.raises(KeyFileClosedError, match='No such file or directory'):
        create(tmp_path / 'nowhere' / 'graph.key')


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(text=st.binary(max_size=80))
def test_no_content_breaks_the_reader(path, text):
    write(path, text)
    with suppress(KeyFileError):
        assert load(path).secret.hex().encode() == text.strip()


@pytest.mark.parametrize('length', [0, 16, 31, 33])
def test_a_key_has_32_bytes(length):
    with pytest.raises(AccessError, match=f'key of {length} bytes: must be 32'):
        Key(bytes(length))


def test_a_key_does_not_print_itself():
    key = Key.random()
    assert key.secret.hex() not in f'{key!r} {key}'
    assert key.fingerprint not in key.secret.hex()
