# SPDX-License-Identifier: Apache-2.0
"""Weight files: round trip, refusal of anything else, no half-written file."""

import os

from dense_weights import every
import numpy as np
import pytest

from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core import weights_file
from srnn_planner.core.errors import SrnnError, WeightsError, WeightsFileError
from srnn_planner.core.pairing import KEPT, Pairing


@pytest.fixture
def weights(rng):
    return WeightsUpdate(3, 123456789, every(rng.uniform(-1, 1, (9, 9)).astype(np.float32)))


def test_saved_weights_come_back_bit_for_bit(tmp_path, weights):
    weights_file.save(tmp_path / 'w.npz', weights)
    loaded = weights_file.load(tmp_path / 'w.npz')
    assert (loaded.version, loaded.segment_stamp_ns) == (3, 123456789)
    assert loaded.learned.same_as(weights.learned)


def test_failed_write_leaves_the_old_file_and_no_other(tmp_path, weights, monkeypatch):
    weights_file.save(tmp_path / 'w.npz', weights)

    def fail(*_):
        raise OSError('disk full')

    monkeypatch.setattr(os, 'fsync', fail)
    with pytest.raises(WeightsFileError, match='disk full'):
        weights_file.save(tmp_path / 'w.npz', WeightsUpdate(4, 5, weights.learned))
    assert weights_file.load(tmp_path / 'w.npz').version == 3
    assert [p.name for p in tmp_path.iterdir()] == ['w.npz']


@pytest.mark.parametrize('content', [b'', b'not an archive', b'PK\x03\x04 broken'])
def test_files_that_are_no_weights_are_refused(tmp_path, content):
    (tmp_path / 'w.npz').write_bytes(content)
    with pytest.raises(WeightsFileError) as error:
        weights_file.load(tmp_path / 'w.npz')
    assert isinstance(error.value, SrnnError)
    assert isinstance(error.value, OSError)


def test_missing_file_is_named(tmp_path):
    with pytest.raises(WeightsFileError, match=r'nowhere\.npz'):
        weights_file.load(tmp_path / 'nowhere.npz')


def test_pickled_objects_are_not_read(tmp_path):
    np.savez(tmp_path / 'w.npz', version=np.array([object()], dtype=object))
    with pytest.raises(WeightsFileError):
        weights_file.load(tmp_path / 'w.npz')


def test_altered_weights_are_refused(tmp_path, weights):
    altered = weights.learned.values.copy()
    altered[0] = 0.5
    np.savez(tmp_path / 'w.npz', **{**weights_file.to_arrays(weights), 'values': altered})
    with pytest.raises(WeightsError, match='checksum'):
        weights_file.load(tmp_path / 'w.npz')


def segment(stamp):
    zeros = np.zeros((4, 2))
    return Segment(stamp, np.linspace(0, 1, 4), zeros, zeros, zeros)


def path(stamp):
    return ExecutedPath(stamp, np.linspace(0, 1, 4), np.zeros((4, 2)))


def test_plan_and_execution_meet_in_either_order():
    pairing = Pairing()
    assert pairing.segment(segment(1)) is None
    assert pairing.executed(path(2)) is None
    assert pairing.executed(path(1))[0].stamp_ns == 1
    assert pairing.segment(segment(2))[1].stamp_ns == 2
    assert pairing.executed(path(1)) is None


def test_pairing_forgets_the_oldest_and_stays_bounded():
    pairing = Pairing()
    for stamp in range(KEPT + 1):
        pairing.segment(segment(stamp))
    assert pairing.executed(path(0)) is None
    assert pairing.executed(path(KEPT)) is not None
