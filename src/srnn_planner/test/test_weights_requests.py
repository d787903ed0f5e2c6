# SPDX-License-Identifier: Apache-2.0
"""Weights that are saved come back; who asks is told in words."""

from lessons import learned_model, pair
import pytest

from srnn_msgs_py.journal import Deed
from srnn_planner.core import weights_file
from srnn_planner.core.errors import SrnnError, WeightsFileError
from srnn_planner.core.weights_requests import WeightsRequests


@pytest.fixture
def model():
    return learned_model()


@pytest.fixture
def changes():
    return []


@pytest.fixture
def requests(model, changes, tmp_path):
    return WeightsRequests(
        model, str(tmp_path / 'w'), lambda: 7, lambda *change: changes.append(change)
    )


def test_what_was_saved_is_gone_on_from_as_a_new_version(requests, model, changes, tmp_path):
    model.learn(*pair(1), 1)
    saved = model.weights
    assert requests.save() == f'saved version 1 to {tmp_path / "w"}'
    assert weights_file.load(tmp_path / 'w').learned.same_as(saved.learned)
    assert changes == []
    model.learn(*pair(2), 2)
    assert requests.load() == f'loaded {tmp_path / "w"} as version 3'
    assert model.weights.learned.same_as(saved.learned)
    assert changes == [(Deed.LOAD, 3)]


def test_the_start_can_be_gone_back_to(requests, model, changes):
    start = model.weights
    model.learn(*pair(1), 1)
    assert requests.revert() == 'back to the initial weights as version 2'
    assert model.weights.learned.same_as(start.learned)
    assert changes == [(Deed.REVERT, 0)]


def test_what_cannot_be_done_changes_nothing(model, changes, tmp_path):
    before = model.weights

    def asked(file):
        return WeightsRequests(model, file, lambda: 7, lambda *change: changes.append(change))

    for action in (asked('').save, asked('').load):
        with pytest.raises(SrnnError, match='parameter weights_file is empty: name a file'):
            action()
    for action in (asked(str(tmp_path / 'no' / 'w')).save, asked(str(tmp_path / 'w')).load):
        with pytest.raises(WeightsFileError):
            action()
    assert model.weights is before
    assert changes == []
