# SPDX-License-Identifier: Apache-2.0
"""Dead weights are noticed, left for the newest good ones, and refused only if those do better."""

from dense_weights import every
from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core.errors import WeightsError
from srnn_planner.core.model_watch import KEPT, ModelWatch

N = 3
PRIOR = every(np.zeros((4, 4), np.float32))


def weights(version, content=None):
    value = (version if content is None else content) / 1000.0
    return WeightsUpdate(version, 10 * version, every(np.full((4, 4), value, np.float32)))


def use(watch, update):
    watch.check(update)
    watch.take(update)


def watch_with(*good):
    watch = ModelWatch(PRIOR, N)
    watch.planned()
    for version in good:
        use(watch, weights(version))
        assert watch.planned() is None
    return watch


def fail(watch, times=N):
    return [watch.failed() for _ in range(times)]


def test_a_few_invalid_plans_change_nothing_and_a_valid_one_starts_the_count_anew():
    watch = watch_with(1, 2)
    for _ in range(5):
        assert fail(watch, N - 1) == [False] * (N - 1)
        assert watch.planned() is None
    assert watch.in_use.version == 2
    assert watch.trouble == ''


def test_dead_weights_are_left_for_the_newest_good_ones_and_refused_when_these_do_better():
    watch = watch_with(1, 2)
    use(watch, weights(3))
    assert fail(watch) == [False] * (N - 1) + [True]
    assert watch.in_use.version == 2
    assert 'version 3: trying older ones' in watch.trouble
    told = watch.planned()
    assert told == WeightsRefusal(3, 2, f'no valid plan in {N} tries with weights version 3')
    assert watch.refusals == 1
    assert watch.trouble == (
        'weights version 3 are dead: planning with those of version 2 until newer ones come'
    )
    assert watch.planned() is None


def test_weights_that_were_good_until_now_are_left_too_and_ever_older_ones_are_tried():
    watch = watch_with(1, 2, 3)
    left = []
    for _ in range(3):
        fail(watch)
        left.append(watch.in_use.version)
    assert left == [2, 1, 0]
    told = watch.planned()
    assert (told.refused_version, told.good_version) == (3, 0)
    assert told.reason.endswith('version 3, 2, 1')


def test_weights_that_never_gave_a_plan_are_not_gone_back_to():
    watch = watch_with(1)
    use(watch, weights(2))
    use(watch, weights(3))
    fail(watch)
    assert watch.in_use.version == 1


def test_where_no_weights_give_a_plan_the_newest_have_their_turn_again_and_none_are_refused():
    watch = watch_with(1, 2)
    seen = []
    for _ in range(9):
        fail(watch)
        seen.append(watch.in_use.version)
    assert seen == [1, 0, 2] * 3
    assert 'any weights' in watch.trouble
    assert watch.planned() is None
    assert (watch.in_use.version, watch.refusals, watch.trouble) == (2, 0, '')
    fail(watch)
    assert watch.in_use.version == 1


def test_dead_initial_weights_are_reported_and_tried_again():
    watch = ModelWatch(PRIOR, N)
    assert fail(watch, 4 * N) == [False] * 4 * N
    assert watch.in_use.version == 0
    assert 'any weights' in watch.trouble
    assert watch.planned() is None
    assert watch.trouble == ''


def test_the_adapter_that_went_back_as_well_ends_the_trouble():
    watch = watch_with(1, 2)
    use(watch, weights(3))
    fail(watch)
    watch.planned()
    use(watch, weights(4, content=2))
    assert watch.trouble == ''
    assert (watch.in_use.version, watch.newest_version) == (4, 4)
    # The same weights are known by one version only: older than they is version 1.
    fail(watch)
    assert watch.in_use.version == 1
    told = watch.planned()
    assert (told.refused_version, told.good_version) == (4, 1)


def test_an_adapter_back_at_the_prior_leaves_nothing_older():
    watch = watch_with()
    use(watch, weights(1))
    fail(watch)
    watch.planned()
    use(watch, WeightsUpdate(2, 0, PRIOR))
    assert (watch.in_use.version, watch.trouble) == (2, '')
    assert fail(watch, 2 * N) == [False] * 2 * N
    assert 'any weights' in watch.trouble


def test_without_an_adapter_planning_goes_on_with_ever_older_weights():
    watch = watch_with(1, 2, 3)
    refused = []
    for _ in range(3):
        fail(watch)
        refused.append(watch.planned().refused_version)
    assert refused == [3, 2, 1]
    assert watch.in_use.version == 0
    assert fail(watch, 5 * N) == [False] * 5 * N


@pytest.mark.parametrize(
    ('update', 'complaint'),
    [
        (weights(2), 'version 2 refused: version 3 is in use'),
        (weights(3, content=5), 'the same version with other content'),
        (weights(3), None),
        (weights(1000), None),
    ],
)
def test_only_newer_weights_take_the_place_of_those_in_use(update, complaint):
    watch = watch_with(3)
    if complaint is None:
        use(watch, update)
        return
    with pytest.raises(WeightsError, match=complaint):
        watch.check(update)
    assert watch.in_use.version == 3


def test_dead_weights_are_not_taken_again_before_newer_ones_come():
    watch = watch_with(1)
    use(watch, weights(2))
    fail(watch)
    for moment in (lambda: None, watch.planned):
        moment()
        with pytest.raises(WeightsError, match='no valid plan was found with it'):
            watch.check(weights(2))
    use(watch, weights(3))
    assert (watch.in_use.version, watch.trouble) == (3, '')


EVENTS = st.lists(st.sampled_from(['plan', 'fail', 'fail', 'fail', 'new', 'same']), max_size=200)


@given(EVENTS)
def test_whatever_happens_memory_is_bounded_and_refusals_name_a_newer_version(events):
    watch, version = ModelWatch(PRIOR, N), 0
    for event in events:
        if event == 'plan':
            told = watch.planned()
            assert told is None or told.refused_version > told.good_version == watch.in_use.version
        elif event == 'fail':
            watch.failed()
        else:
            version += 1
            content = version if event == 'new' else round(1000 * watch.in_use.learned.values[0])
            use(watch, weights(version, content))
        assert len(watch._good) <= KEPT
        assert len(watch._dead) <= KEPT + 1
        assert watch.newest_version == version
        assert (watch.in_use.version < version) == bool(watch.trouble) or 'any' in watch.trouble
