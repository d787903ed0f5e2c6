# SPDX-License-Identifier: Apache-2.0
"""What the gate lets through, and that nothing else gets through."""

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
from perfect_arm import PerfectArm
import pytest
from segments import MS, chain, line, replaced

from lwr_tracking.core.parameters import TrackerParameters
from lwr_tracking.core.quintic_path import PathState, QuinticPath
from lwr_tracking.core.refusal import Refusal
from lwr_tracking.core.segment_gate import Admission, Join, judge
from srnn_msgs_py.result import ResultCode
from srnn_msgs_py.segment import Segment

PARAMETERS = TrackerParameters()
GATE = PARAMETERS.gate
GOOD = line((0.0, 0.0), (0.1, 0.05), 0.1, stamp_ns=5 * MS)
REST = Join(PathState(0.0, 0.0), last_stamp_ns=MS)
ARRAYS = ('times', 'positions', 'velocities', 'accelerations')


def verdict(segment, join=REST, age=0.1):
    return judge(segment, join, age, PARAMETERS)


def altered(field, change, segment=GOOD):
    array = getattr(segment, field).copy()
    changed = change(array)
    return replaced(segment, **{field: array if changed is None else changed})


def with_value(field, index, value):
    def change(array):
        array.flat[index % array.size] = value

    return altered(field, change)


fields = st.sampled_from(ARRAYS)
indices = st.integers(0, 10_000)
bad_segments = st.one_of(
    st.builds(with_value, fields, indices, st.sampled_from([np.nan, np.inf, -np.inf, 1e300])),
    st.builds(lambda f, n: altered(f, lambda a: a[:n]), fields, st.integers(0, 29)),
    st.builds(lambda f: altered(f, lambda a: np.concatenate((a, a))), fields),
    st.builds(lambda f: altered(f, lambda a: a.reshape(-1)), st.sampled_from(ARRAYS[1:])),
    st.builds(lambda f: altered(f, lambda a: a[..., None]), fields),
    st.builds(
        lambda f: altered(f, lambda a: np.column_stack((a, a[:, :1]))), st.sampled_from(ARRAYS[1:])
    ),
    st.builds(lambda i: with_value('times', i, -0.1), indices),
    st.builds(
        lambda i: altered('times', lambda a: a.__setitem__(1 + i % 29, a[i % 29])), indices
    ),
    st.builds(lambda i, v: with_value('positions', i, v), indices,
              st.floats(0.296, 1e6) | st.floats(-1e6, -0.296)),
    st.builds(lambda i, v: with_value('velocities', i, v), indices,
              st.floats(0.26, 1e6) | st.floats(-1e6, -0.26)),
    st.builds(lambda i, v: with_value('accelerations', i, v), indices,
              st.floats(3.1, 1e6) | st.floats(-1e6, -3.1)),
    st.builds(
        lambda d, a: altered('positions', lambda p: p + d * np.array((np.cos(a), np.sin(a)))),
        st.floats(0.0101, 0.3), st.floats(0.0, 7.0),
    ),
    st.builds(lambda frame: replaced(GOOD, frame=frame), st.sampled_from(('', 'world', 'x'))),
    st.builds(lambda stamp: replaced(GOOD, stamp_ns=stamp), st.integers(-(2**62), MS)),
)
bad_ages = st.floats(0.5001, 1e9) | st.sampled_from([np.nan, np.inf])


def test_the_good_one_is_good():
    admission = verdict(GOOD)
    assert isinstance(admission, Admission)
    assert admission.segment is GOOD
    assert admission.from_rest
    assert admission.room == 0.0


@settings(max_examples=400)
@given(bad_segments)
def test_a_broken_segment_is_refused(segment):
    assert isinstance(verdict(segment), Refusal)


@given(bad_ages)
def test_an_old_segment_is_stale(age):
    assert verdict(GOOD, age=age) is Refusal.STALE


def test_ten_thousand_values_that_are_not_finite_never_pass():
    rng = np.random.default_rng(1)
    for _ in range(10_000):
        field = ARRAYS[rng.integers(4)]
        value = (np.nan, np.inf, -np.inf)[rng.integers(3)]
        assert verdict(with_value(field, int(rng.integers(60)), value)) is Refusal.NOT_FINITE


@settings(max_examples=60)
@given(st.lists(st.tuples(bad_segments, st.just(0.0)) | st.tuples(st.just(GOOD), bad_ages),
                min_size=1, max_size=5), st.integers(1, 80))
def test_what_is_refused_leaves_the_motion_bit_identical(offers, after):
    clean, attacked = PerfectArm(), PerfectArm()
    for arm in (clean, attacked):
        arm.tick()
        assert arm.tracker.offer(replaced(GOOD, stamp_ns=2 * MS), 0.0) is None
    for i in range(after + 5):
        if i == after:
            for segment, age in offers:
                result = attacked.tracker.offer(segment, age)
                assert result is not None
                assert result.stamp_ns == segment.stamp_ns
                assert result.code in (ResultCode.REJECTED, ResultCode.STALE)
                assert result.reason
            assert attacked.tracker.reference.waiting is None
        clean.tick()
        attacked.tick()
        assert clean.q.tobytes() == attacked.q.tobytes()
        assert clean.tracker.reference.join() == attacked.tracker.reference.join()
    assert sum(attacked.tracker.counters.refused.values()) == len(offers)


@pytest.mark.parametrize(('segment', 'refusal'), [
    (replaced(GOOD, frame='world'), Refusal.FRAME),
    (altered('velocities', lambda a: a[:-1]), Refusal.SHAPE),
    (Segment(5 * MS, *(getattr(GOOD, f)[:1] for f in ARRAYS)), Refusal.KNOTS),
    (Segment(5 * MS, *(getattr(GOOD, f)[:0] for f in ARRAYS)), Refusal.KNOTS),
    (Segment(5 * MS, np.arange(100_000.0), *np.zeros((3, 100_000, 2))), Refusal.KNOTS),
    (with_value('positions', 7, np.nan), Refusal.NOT_FINITE),
    (with_value('times', 0, 0.001), Refusal.TIMES),
    (with_value('times', 9, 0.0), Refusal.TIMES),
    (replaced(GOOD, stamp_ns=MS), Refusal.DUPLICATE),
    (replaced(GOOD, stamp_ns=MS - 1), Refusal.OUT_OF_ORDER),
    (line((0.011, 0.0), (0.1, 0.0), 0.1, stamp_ns=5 * MS), Refusal.START_POSITION),
    (with_value('velocities', 0, 0.013), Refusal.START_VELOCITY),
    (line((0.0, 0.0), (0.2951, 0.0), 0.1, stamp_ns=5 * MS), Refusal.OUTSIDE),
    (line((0.0, 0.0), (0.2, 0.0), 0.26, stamp_ns=5 * MS), Refusal.JUMP),
    (with_value('positions', 30, 0.2), Refusal.JUMP),
    (with_value('velocities', 30, 0.26), Refusal.SPEED),
    (with_value('accelerations', 30, 3.1), Refusal.ACCELERATION),
])
def test_each_rule_has_its_name(segment, refusal):
    assert verdict(segment) is refusal


def test_a_fast_end_without_room_to_stop_is_refused():
    times = np.array([0.0, 0.05])
    velocity = np.full((2, 2), 0.17)
    start = Join(PathState(0.0, 0.0, 0.17, 0.17))
    short = Segment(MS, times, times[:, None] * velocity, velocity, np.zeros((2, 2)))
    assert verdict(short, start) is Refusal.NO_ROOM


def test_a_moving_start_after_braking_has_begun_is_late():
    moving = chain([(0.0, 0.0), (0.2, 0.0)], 0.1, duration=1.0)[1]
    x, y = moving.positions[0]
    assert verdict(moving, Join(PathState(x, y), late=True)) is Refusal.LATE
    assert verdict(moving, Join(PathState(x, y))) is Refusal.START_VELOCITY


@given(st.floats(0.0, 0.0099), st.floats(0.0, 7.0), st.floats(0.0, 0.0119))
def test_a_small_offset_is_blended_out_without_a_jump(distance, angle, speed):
    c, s = np.cos(angle), np.sin(angle)
    state = PathState(distance * c, distance * s, -speed * s, speed * c)
    admission = verdict(GOOD, Join(state))
    assert isinstance(admission, Admission)
    np.testing.assert_allclose(admission.path.state(0.0), state, atol=1e-12)
    late = np.linspace(GATE.blend + 0.06, GOOD.duration, 50)
    plain = QuinticPath(GOOD.times, GOOD.positions, GOOD.velocities, GOOD.accelerations)
    for ours, theirs in zip(admission.path.evaluate(late), plain.evaluate(late), strict=True):
        np.testing.assert_allclose(ours, theirs, atol=1e-9)


@settings(max_examples=300)
@given(st.integers(0, 2**32 - 1), st.floats(0.0, 1.0), st.integers(2, 12))
def test_whatever_is_admitted_stays_within_the_limits_between_the_knots(seed, rough, knots):
    rng = np.random.default_rng(seed)
    times = np.append(0.0, np.cumsum(rng.uniform(0.02, 0.2, knots - 1)))
    noise = rough * rng.normal(size=(3, knots, 2))
    positions = 0.2 * rng.uniform(-1, 1, 2) * times[:, None] + 0.01 * noise[0]
    velocities = np.gradient(positions, times, axis=0) + 0.1 * noise[1]
    segment = Segment(MS, times, positions, velocities, noise[2])
    join = Join(PathState(*positions[0], *velocities[0]))
    admission = verdict(segment, join)
    if isinstance(admission, Admission):
        p, v, a = admission.path.evaluate(np.linspace(0.0, times[-1], 400))
        assert np.abs(p).max() <= GATE.half_width
        assert np.hypot(*v.T).max() <= 1.05 * GATE.speed_limit
        assert np.hypot(*a.T).max() <= 1.25 * GATE.acceleration_limit
