# SPDX-License-Identifier: Apache-2.0
"""Weight files that are made to hurt: refused by name, without the memory they ask for."""

import io
import os
import tracemalloc
import zipfile

from dense_weights import every
from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core import archive, weights_file
from srnn_planner.core.errors import SrnnError, WeightsError, WeightsFileError

GOOD = WeightsUpdate(3, 5, every(np.eye(9, dtype=np.float32)))
VALUES = GOOD.learned.values


def arrays(**changes):
    return {**weights_file.to_arrays(GOOD), **changes}


def npy(header, data=b''):
    """Return an array file with a header of its own."""
    text = header.encode('latin1') + b'\n'
    return b'\x93NUMPY\x01\x00' + len(text).to_bytes(2, 'little') + text + data


def member(name, content, compression=zipfile.ZIP_DEFLATED):
    """Return a good archive in which one member is replaced."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, 'w', compression) as file:
        for key, value in arrays().items():
            plain = io.BytesIO()
            np.save(plain, value)
            file.writestr(f'{key}.npy', content if key == name else plain.getvalue())
    return buffer.getvalue()


def bytes_of(**changes):
    buffer = io.BytesIO()
    np.savez(buffer, **arrays(**changes))
    return buffer.getvalue()


def without(name):
    buffer = io.BytesIO()
    np.savez(buffer, **{key: value for key, value in arrays().items() if key != name})
    return buffer.getvalue()


def crowded():
    buffer = io.BytesIO(bytes_of())
    with zipfile.ZipFile(buffer, 'a') as file:
        for n in range(1000):
            file.writestr(f'{n}.npy', b'')
    return buffer.getvalue()


BOMB = "{'descr': '<f4', 'fortran_order': False, 'shape': (81,), }"
HOSTILE = {
    'bomb of zeros': member('values', npy(BOMB, bytes(50_000_000))),
    'huge declared array': member('values', npy(BOMB.replace('81,', '10**12,'))),
    'huge declared number': member('values', npy(BOMB.replace('81,', '9' * 3000 + ','))),
    'large declared array': member('values', npy(BOMB.replace('81,', '10000000000,'))),
    'negative shape': member('values', npy(BOMB.replace('81,', '-81,'))),
    'deep header': member('values', npy('(' * 5000)),
    'code as header': member('values', npy("__import__('os').abort()")),
    'endless header': member('values', npy(' ' * 60_000 + BOMB)),
    'array cut off': member('values', npy(BOMB, bytes(17))),
    'array too long': member('values', npy(BOMB, bytes(500))),
    'no array': member('values', b'PK'),
    'array of later format': member('values', b'\x93NUMPY\x03\x00' + bytes(100)),
    'pickled objects': bytes_of(values=np.array([GOOD], dtype=object)),
    'pickled version': bytes_of(version=np.array(GOOD, dtype=object)),
    'text as version': bytes_of(version=np.array('3')),
    'many versions': bytes_of(version=np.arange(3)),
    'negative version': bytes_of(version=np.int64(-3)),
    'other number type': bytes_of(values=VALUES.astype(np.float64)),
    'number type of the same size': bytes_of(version=np.float64(3.0)),
    'not flat': bytes_of(values=VALUES.reshape(9, 9)),
    'too many members': crowded(),
    'truncated': bytes_of()[:-1],
    'half': bytes_of()[: len(bytes_of()) // 2],
    'trailing bytes': bytes_of() + b'x',
    **{f'without {name}': without(name) for name in arrays()},
}
UNSOUND = {
    'too few': bytes_of(values=VALUES[:80]),
    'out of order': bytes_of(synapses=np.arange(81)[::-1]),
    'beyond the network': bytes_of(synapses=np.arange(81) + 1),
    'too large': bytes_of(values=VALUES * np.float32(1.5)),
    'not finite': bytes_of(values=VALUES * np.float32('nan')),
    'version without room': bytes_of(version=np.int64(weights_file.LATEST + 1)),
    'other checksum': bytes_of(checksum=np.uint32(1)),
    'other content': bytes_of(values=VALUES * np.float32(0.5)),
}


@pytest.mark.parametrize('content', HOSTILE.values(), ids=HOSTILE)
def test_hostile_files_are_refused_by_name_and_without_their_memory(tmp_path, content):
    path = tmp_path / 'weights.npz'
    path.write_bytes(content)
    tracemalloc.start()
    try:
        with pytest.raises(WeightsFileError, match=r'weights\.npz: is no weight file'):
            weights_file.load(path)
        assert tracemalloc.get_traced_memory()[1] < 2_000_000
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize('content', UNSOUND.values(), ids=UNSOUND)
def test_files_whose_content_contradicts_itself_are_refused(tmp_path, content):
    path = tmp_path / 'weights.npz'
    path.write_bytes(content)
    with pytest.raises(WeightsError, match=r'weights\.npz'):
        weights_file.load(path)


def test_a_huge_file_is_not_read(tmp_path):
    with (tmp_path / 'w').open('wb') as file:
        file.truncate(archive.MAX_FILE_BYTES + 1)
    with pytest.raises(WeightsFileError, match='larger than'):
        weights_file.load(tmp_path / 'w')


def test_an_array_is_not_unpacked_beyond_the_limit(tmp_path, monkeypatch):
    bomb = member('values', npy(BOMB.replace('81,', '4000000,'), bytes(16_000_000)))
    monkeypatch.setattr(archive, 'MAX_FILE_BYTES', 100_000)
    assert len(bomb) < archive.MAX_FILE_BYTES
    (tmp_path / 'w').write_bytes(bomb)
    tracemalloc.start()
    try:
        with pytest.raises(WeightsFileError, match='16000000 bytes: must be at most 100000'):
            weights_file.load(tmp_path / 'w')
        assert tracemalloc.get_traced_memory()[1] < 2_000_000
    finally:
        tracemalloc.stop()


def test_what_could_not_be_read_again_is_not_written(tmp_path, monkeypatch):
    monkeypatch.setattr(archive, 'MAX_FILE_BYTES', 1000)
    with pytest.raises(WeightsFileError, match='w: cannot be written: .* at most 1000'):
        weights_file.save(tmp_path / 'w', GOOD)
    assert not (tmp_path / 'w').exists()


@pytest.mark.parametrize('kind', ['folder', 'pipe', 'link'])
def test_what_is_no_regular_file_is_refused_at_once(tmp_path, kind):
    weights_file.save(tmp_path / 'real', GOOD)
    place = tmp_path / 'w'
    make = {
        'folder': place.mkdir, 'pipe': lambda: os.mkfifo(place),
        'link': lambda: place.symlink_to('real'),
    }  # fmt: skip
    make[kind]()
    with pytest.raises(WeightsFileError, match='is no regular file|is a symbolic link'):
        weights_file.load(place)


def test_files_of_other_tools_are_read_compressed_or_not(tmp_path):
    np.savez_compressed(tmp_path / 'w.npz', **arrays())
    assert weights_file.load(tmp_path / 'w.npz').learned.same_as(GOOD.learned)


@given(st.integers(0, len(bytes_of()) - 1), st.integers(1, 255))
def test_one_changed_byte_never_changes_the_weights(tmp_path_factory, where, change):
    content = bytearray(bytes_of())
    content[where] ^= change
    path = tmp_path_factory.getbasetemp() / 'fuzzed.npz'
    path.write_bytes(content)
    try:
        loaded = weights_file.load(path)
    except SrnnError:
        return
    # A date, say, or a name that is not needed.
    assert (loaded.version, loaded.segment_stamp_ns) == (3, 5)
    assert loaded.learned.same_as(GOOD.learned)
