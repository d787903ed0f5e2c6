# SPDX-License-Identifier: Apache-2.0
"""Checkpoints: whole or not at all, one before the newest, and broken ones kept aside."""

from dataclasses import replace
import errno
import os

from dense_weights import every
from lessons import MODEL, SMALL, learned_model, pair
import numpy as np
import pytest

from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core import checkpoint, durable_file, weights_file
from srnn_planner.core.checkpoint_keeper import CheckpointKeeper
from srnn_planner.core.errors import SrnnError, WeightsFileError
from srnn_planner.core.history import LENGTH
from srnn_planner.core.lineage import KEPT
from srnn_planner.core.state_neurons import StateNeurons


def taught(*stamps):
    model = learned_model()
    for stamp in stamps:
        assert model.learn(*pair(stamp), stamp).updated
    return model


def names(folder):
    return sorted(place.name for place in folder.iterdir())


def restored(keeper):
    model = learned_model()
    return model, keeper.restore(lambda value: model.restore(value, 9))


def test_a_checkpoint_comes_back_complete(tmp_path):
    before = taught(*range(1, KEPT + 3)).checkpoint()
    checkpoint.save(tmp_path / 'c', before)
    after = checkpoint.load(tmp_path / 'c')
    assert len(after.earlier) == KEPT
    for old, new in zip((before.weights, *before.earlier), (after.weights, *after.earlier),
                        strict=True):
        assert (old.version, old.segment_stamp_ns) == (new.version, new.segment_stamp_ns)
        assert old.learned.same_as(new.learned)
    assert (after.updates, after.reverts) == (before.updates, before.reverts)
    assert np.array_equal(after.generator, before.generator)
    assert np.array_equal(after.history, before.history)


def test_a_checkpoint_is_a_weight_file_as_well(tmp_path):
    model = taught(1)
    checkpoint.save(tmp_path / 'c', model.checkpoint())
    loaded = weights_file.load(tmp_path / 'c')
    assert loaded.version == 1
    assert loaded.learned.same_as(model.weights.learned)


def damaged(**changes):
    def save(path):
        value = replace(taught(1, 2).checkpoint(), **changes)
        checkpoint.save(path, value)

    return save


def truncated(path):
    checkpoint.save(path, taught(1, 2).checkpoint())
    os.truncate(path, path.stat().st_size - 100)


def flipped(path):
    checkpoint.save(path, taught(1, 2).checkpoint())
    content = bytearray(path.read_bytes())
    # In the middle of an earlier version, which no checksum of ours covers.
    values = checkpoint.load(path).earlier[-1].learned.values.tobytes()
    content[content.rindex(values) + len(values) // 2] ^= 1
    path.write_bytes(content)


def only_weights(path):
    weights_file.save(path, taught(1).weights)


def other_network(path):
    other = learned_model(model=replace(MODEL, network=replace(SMALL, neurons_per_dimension=4)))
    checkpoint.save(path, other.checkpoint())


PRIOR = StateNeurons(SMALL).prior.checksum
ZEROS = every(np.zeros((25, 25), np.float32), PRIOR)
TOO_MANY = replace(ZEROS, synapses=np.arange(625) + 1)
BROKEN = {
    'truncated': truncated,
    'a flipped bit': flipped,
    'only weights': only_weights,
    'of another network': other_network,
    'random numbers of nothing': damaged(generator=np.zeros(6, np.uint64)),
    'versions that fall': damaged(earlier=(WeightsUpdate(5, 0, ZEROS),)),
    'negative versions': damaged(earlier=(WeightsUpdate(-1, 0, ZEROS),)),
    'earlier weights of another size': damaged(earlier=(WeightsUpdate(0, 0, TOO_MANY),)),
    'too many events': damaged(history=np.zeros(LENGTH + 1, taught().history.records.dtype)),
    'too many versions': damaged(
        weights=WeightsUpdate(99, 0, ZEROS),
        earlier=tuple(WeightsUpdate(n, 0, ZEROS) for n in range(KEPT + 1)),
    ),
    'events of other types': damaged(history=np.zeros(3)),
    'nothing': lambda path: path.write_bytes(b''),
}


@pytest.mark.parametrize('spoil', BROKEN.values(), ids=BROKEN)
def test_a_broken_checkpoint_is_kept_aside_and_the_one_before_is_gone_on_from(tmp_path, spoil):
    keeper = CheckpointKeeper(str(tmp_path / 'c'))
    keeper.keep(taught(1).checkpoint())
    keeper.keep(taught(1, 2).checkpoint())
    (tmp_path / 'c').unlink()
    spoil(tmp_path / 'c')
    content = (tmp_path / 'c').read_bytes()
    # What spoils the file writes it twice at most, and so may have replaced the one before.
    checkpoint.save(tmp_path / 'd', taught(1).checkpoint())
    os.replace(tmp_path / 'd', tmp_path / 'c.previous')
    keeper = CheckpointKeeper(str(tmp_path / 'c'))
    model, found = restored(keeper)
    assert found
    assert (model.weights.version, keeper.version) == (1, 1)
    assert 'kept as c.broken' in keeper.broken
    assert (tmp_path / 'c.broken').read_bytes() == content
    assert names(tmp_path) == ['c.broken', 'c.previous']
    # Killed before anything was kept: the next start goes on from the same one.
    assert restored(CheckpointKeeper(str(tmp_path / 'c')))[0].weights.version == 1


@pytest.mark.parametrize('spoil', BROKEN.values(), ids=BROKEN)
def test_without_one_before_learning_begins_anew_and_nothing_is_thrown_away(tmp_path, spoil):
    for found in (1, 2, 3):
        spoil(tmp_path / 'c')
        (tmp_path / 'c.previous').unlink(missing_ok=True)
        keeper = CheckpointKeeper(str(tmp_path / 'c'))
        model, was_there = restored(keeper)
        assert not was_there
        assert keeper.version is None
        assert model.weights.version == 0
        assert str(tmp_path / 'c') in keeper.broken
        assert names(tmp_path) == ['c.broken', 'c.broken1', 'c.broken2'][:found]


def test_the_checkpoint_before_the_newest_stays(tmp_path):
    keeper = CheckpointKeeper(str(tmp_path / 'c'))
    model = learned_model()
    for stamp in range(1, 5):
        model.learn(*pair(stamp), 0)
        keeper.keep(model.checkpoint())
        assert keeper.version == checkpoint.load(tmp_path / 'c').weights.version == stamp
    assert checkpoint.load(durable_file.previous(tmp_path / 'c')).weights.version == 3
    assert names(tmp_path) == ['c', 'c.previous']


@pytest.mark.parametrize('call', ['write', 'fsync', 'replace', 'mkstemp'])
def test_a_full_disk_is_reported_and_tried_again_with_the_next_update(
    tmp_path, monkeypatch, call
):
    keeper = CheckpointKeeper(str(tmp_path / 'c'))
    model = taught(1)
    keeper.keep(model.checkpoint())
    content = (tmp_path / 'c').read_bytes()

    def full(*_, **__):
        raise OSError(errno.ENOSPC, 'No space left on device')

    with monkeypatch.context() as patch:
        if call == 'write':
            patch.setattr(durable_file.os, 'fdopen', lambda *a: FullFile(full, *a))
        else:
            place = durable_file.tempfile if call == 'mkstemp' else os
            patch.setattr(place, call, full)
        model.learn(*pair(2), 0)
        keeper.keep(model.checkpoint())
        keeper.keep_refused(model.weights)
    assert 'No space left on device' in keeper.unsaved
    assert keeper.version == 1
    assert (tmp_path / 'c').read_bytes() == content
    assert [name for name in names(tmp_path) if name.startswith('.')] == []
    model.learn(*pair(3), 0)
    keeper.keep(model.checkpoint())
    assert (keeper.unsaved, keeper.version) == ('', 3)
    assert len(checkpoint.load(tmp_path / 'c').earlier) == 3


class FullFile:
    """A file that takes half of what is written to it."""

    def __init__(self, full, handle, mode):
        self._file, self._full = open(handle, mode), full  # noqa: SIM115

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._file.close()

    def write(self, content):
        self._file.write(content[: len(content) // 2])
        self._full()


def test_what_killed_writers_have_left_is_removed(tmp_path):
    for name in ('.c.abc', '.c.abc.old', '.d.abc', 'c.other'):
        (tmp_path / name).write_bytes(b'x')
    CheckpointKeeper(str(tmp_path / 'c'))
    assert names(tmp_path) == ['.d.abc', 'c.other']


def test_weights_that_were_left_are_kept_as_a_weight_file(tmp_path):
    keeper = CheckpointKeeper(str(tmp_path / 'c'))
    left = taught(1, 2).weights
    keeper.keep_refused(left)
    assert weights_file.load(tmp_path / 'c.refused').learned.same_as(left.learned)


def test_without_a_place_nothing_is_kept():
    keeper = CheckpointKeeper('')
    keeper.keep(taught(1).checkpoint())
    keeper.keep_refused(taught(1).weights)
    assert not restored(keeper)[1]
    assert (keeper.version, keeper.unsaved, keeper.broken) == (None, '', '')


@pytest.mark.parametrize('name', ['c', 'c.previous'])
@pytest.mark.parametrize('kind', ['folder', 'pipe', 'link', 'dangling link'])
def test_a_place_that_is_no_file_is_refused_and_left_alone(tmp_path, name, kind):
    (tmp_path / 'real').write_bytes(b'x')
    place = tmp_path / name
    make = {
        'folder': place.mkdir,
        'pipe': lambda: os.mkfifo(place),
        'link': lambda: place.symlink_to(tmp_path / 'real'),
        'dangling link': lambda: place.symlink_to(tmp_path / 'nowhere'),
    }
    make[kind]()
    before = names(tmp_path)
    with pytest.raises(WeightsFileError, match=f'{name} is no regular file') as caught:
        CheckpointKeeper(str(tmp_path / 'c'))
    assert isinstance(caught.value, SrnnError)
    assert names(tmp_path) == before


def test_a_place_in_no_folder_is_refused(tmp_path):
    with pytest.raises(WeightsFileError, match='no directory to hold it'):
        CheckpointKeeper(str(tmp_path / 'nowhere' / 'c'))
