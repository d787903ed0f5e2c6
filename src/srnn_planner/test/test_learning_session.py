# SPDX-License-Identifier: Apache-2.0
"""What an adapter does with what it hears, what it notes of that, and what it tells."""

from lessons import MODEL, pair
import numpy as np
import pytest

from srnn_msgs_py.health import HealthLevel
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.segment import ExecutedPath
from srnn_planner.core.adapter_health import adapter_health
from srnn_planner.core.checkpoint_keeper import CheckpointKeeper
from srnn_planner.core.errors import PairingError
from srnn_planner.core.learning_session import LearningSession
from srnn_planner.core.statistics import Durations


@pytest.fixture
def notes():
    return []


@pytest.fixture
def session(notes):
    return LearningSession(MODEL, 1, note=lambda *numbers: notes.append(numbers))


def taught(session, *stamps):
    for stamp in stamps:
        plan, path = pair(stamp)
        session.segment(plan, stamp)
        learned = session.executed(path, stamp)
    return learned


def test_what_is_heard_is_noted_whether_it_teaches_or_not(session, notes):
    assert taught(session, 1) is None
    session.begin()
    assert taught(session, 2).lesson.updated
    session.segment(pair(3)[0], 3)
    with pytest.raises(PairingError):
        session.executed(ExecutedPath(3, np.arange(2.0), np.zeros((2, 3))), 3)
    session.end()
    assert taught(session, 4) is None
    assert notes == [
        (Deed.PLAN, 1), (Deed.EXECUTED, 1), (Deed.ACTIVATED,), (Deed.PLAN, 2), (Deed.EXECUTED, 2),
        (Deed.PLAN, 3), (Deed.EXECUTED, 3), (Deed.DEACTIVATED,), (Deed.PLAN, 4),
        (Deed.EXECUTED, 4),
    ]  # fmt: skip


def test_a_lesson_is_acknowledged_with_the_weights_that_came_of_it(session):
    session.begin()
    learned = taught(session, 1)
    told, shared = session.acknowledgement(learned, 4.0), session.shared(1)
    assert (told.segment_stamp_ns, told.updated, told.update_ms) == (1, True, 4.0)
    assert told.weights_version == shared.version == 1
    assert told.peak == learned.lesson.peak
    assert told.global_alpha.dtype == told.neuron_peak.dtype == np.float32
    assert shared.segment_stamp_ns == 1
    assert shared.learned.same_as(session.learner.synapses.learned)


def test_dead_weights_are_left_and_that_is_told_until_something_was_learned(session, notes):
    session.begin()
    taught(session, 1, 4)
    dead = session.shared(0)
    went_back = session.refused(WeightsRefusal(2, 1, 'no plan'), 9)
    assert notes[-1] == (Deed.REFUSED, 2, 1)
    assert went_back.left.learned.same_as(dead.learned)
    assert not session.shared(0).learned.same_as(dead.learned)
    assert went_back.words == session.went_back
    assert went_back.words == 'left weights version 2 for earlier ones, now version 3: no plan'
    taught(session, 5)
    assert session.went_back == ''


def test_dead_weights_of_another_only_raise_the_version(session):
    session.begin()
    taught(session, 1)
    before = session.shared(0)
    went_back = session.refused(WeightsRefusal(40, 39, 'no plan'), 9)
    assert went_back.left is None
    assert went_back.words == 'went on with the same weights, now version 41: no plan'
    assert session.shared(0).learned.same_as(before.learned)
    assert session.refused(WeightsRefusal(40, 39, 'no plan'), 10) is None


def test_health_warns_of_what_was_left_and_of_what_cannot_be_kept(session, tmp_path):
    keeper = CheckpointKeeper(str(tmp_path / 'c'))
    session.begin()
    taught(session, 1, 2)
    health = adapter_health(session, keeper, Durations())
    assert (health.level, health.message) == (HealthLevel.OK, '')
    assert health.values['checkpoint_version'] == 'none'
    assert (health.values['updates'], health.values['weights_version']) == (2, 2)
    session.refused(WeightsRefusal(2, 1, 'no plan'), 9)
    (tmp_path / 'c').mkdir()
    keeper.keep(session.model.checkpoint())
    health = adapter_health(session, keeper, Durations())
    assert health.level is HealthLevel.WARN
    assert health.message == f'{keeper.unsaved}; {session.went_back}'
    assert health.values['checkpoint_error'] == keeper.unsaved != ''
    assert health.values['reverts'] == 1
