# SPDX-License-Identifier: Apache-2.0
"""Segments with one thing wrong, at random, and what the gate has to say about each."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from segments import line, replaced

from lwr_tracking.core.refusal import Refusal
from srnn_msgs_py.segment import Segment

ARRAYS = ('times', 'positions', 'velocities', 'accelerations')
MOTION = ARRAYS[1:]
MANY = 100_000

Random = np.random.Generator
Offer = tuple[Segment, float]
"""A segment and its age [s]."""


@dataclass(frozen=True)
class Garbage:
    """One way to spoil a segment.

    Attributes:
        row: of the fault matrix.
        refusals: the reasons that may be given.
        spoil: turns a good segment into a bad one.

    """

    row: int
    refusals: frozenset[Refusal]
    spoil: Callable[[Segment, Random], Offer]


def _fresh(spoil: Callable[[Segment, Random], Segment]) -> Callable[[Segment, Random], Offer]:
    return lambda segment, rng: (spoil(segment, rng), 0.0)


def _sign(rng: Random) -> float:
    return float(rng.choice([-1.0, 1.0]))


def _way(rng: Random, length: float) -> np.ndarray:
    angle = rng.uniform(0.0, 2.0 * np.pi)
    return length * np.array((np.cos(angle), np.sin(angle)))


def _with(segment: Segment, field: str, value: float, rng: Random, first: int = 0) -> Segment:
    """Set one value of a knot from number `first` on."""
    array = getattr(segment, field).copy()
    knot = rng.integers(first, len(array))
    array[knot, ...].flat[rng.integers(array[knot, ...].size)] = value
    if array.ndim == 1:
        array[knot] = value
    return replaced(segment, **{field: array})


def _moved(segment: Segment, field: str, by: np.ndarray, knots: object) -> Segment:
    array = getattr(segment, field).copy()
    array[knots] += by
    return replaced(segment, **{field: array})


def _not_a_number(segment: Segment, rng: Random) -> Segment:
    return _with(segment, rng.choice(ARRAYS), np.nan, rng)


def _infinite(segment: Segment, rng: Random) -> Segment:
    return _with(segment, rng.choice(ARRAYS), _sign(rng) * np.inf, rng)


def _huge(segment: Segment, rng: Random) -> Segment:
    return _with(segment, rng.choice(ARRAYS), _sign(rng) * 10.0 ** rng.uniform(6, 308), rng)


def _outside(segment: Segment, rng: Random) -> Segment:
    start = segment.positions[0]
    end = rng.uniform(-0.29, 0.29, 2)
    end[rng.integers(2)] = _sign(rng) * rng.uniform(0.2952, 1.0)
    return line(tuple(start), tuple(end), rng.uniform(0.05, 0.2), segment.stamp_ns)


def _off_height(segment: Segment, rng: Random) -> Segment:
    column = np.full((len(segment.times), 1), rng.uniform(-0.1, 0.1))
    return replaced(segment, **{f: np.hstack((getattr(segment, f), column)) for f in MOTION})


def _elsewhere(segment: Segment, rng: Random) -> Segment:
    return _moved(segment, 'positions', _way(rng, rng.uniform(0.0101, 0.6)), slice(None))


def _other_velocity(segment: Segment, rng: Random) -> Segment:
    return _moved(segment, 'velocities', _way(rng, rng.uniform(0.0121, 1.0)), 0)


def _step(segment: Segment, rng: Random) -> Segment:
    knot = rng.integers(1, len(segment.times))
    return _moved(segment, 'positions', _way(rng, rng.uniform(0.1, 0.5)), knot)


def _fast(segment: Segment, rng: Random) -> Segment:
    share = np.ptp(segment.times) / np.hypot(*np.diff(segment.positions, axis=0).T).sum()
    times = segment.times / (share * rng.uniform(0.3, 3.0))
    scale = segment.times[-1] / times[-1]
    return replaced(
        segment, times=times, velocities=scale * segment.velocities,
        accelerations=scale**2 * segment.accelerations,
    )  # fmt: skip


def _hard(segment: Segment, rng: Random) -> Segment:
    knot = rng.integers(len(segment.times))
    return _moved(segment, 'accelerations', _way(rng, 10.0 ** rng.uniform(0.9, 6.0)), knot)


def _old(segment: Segment, rng: Random) -> Offer:
    return segment, float(rng.choice([rng.uniform(0.501, 1e4), np.inf, np.nan]))


def _again(segment: Segment, rng: Random) -> Segment:
    return replaced(segment, stamp_ns=segment.stamp_ns - 1)


def _earlier(segment: Segment, rng: Random) -> Segment:
    return replaced(segment, stamp_ns=segment.stamp_ns - int(10 ** rng.uniform(1.0, 18.0)))


def _points(count: int) -> Callable[[Segment, Random], Segment]:
    def spoil(segment: Segment, rng: Random) -> Segment:
        times = 0.01 * np.arange(count)
        still = np.broadcast_to(segment.positions[0], (count, 2))
        none = np.broadcast_to(0.0, (count, 2))
        return Segment(segment.stamp_ns, times, still, none, none)

    return spoil


def _timeless(segment: Segment, rng: Random) -> Segment:
    times = segment.times.copy()
    knot = rng.integers(1, len(times))
    times[knot] = times[knot - 1] - rng.choice([0.0, rng.uniform(0.0, 10.0)])
    return replaced(segment, times=times)


def _lost_in_space(segment: Segment, rng: Random) -> Segment:
    return replaced(segment, frame=rng.choice(['', 'world', 'lwr_base_link', 'srnn_workspace ']))


def _misshapen(segment: Segment, rng: Random) -> Segment:
    field = rng.choice(ARRAYS)
    array = getattr(segment, field)
    shapes = (
        array[: rng.integers(len(array))], np.concatenate((array, array)), array[..., None],
        array.sum(), array.reshape(-1, 1), np.stack((array, array)),
    )  # fmt: skip
    return replaced(segment, **{field: np.asarray(shapes[rng.integers(len(shapes))])})


ANY = frozenset(Refusal)
MOVES = frozenset({Refusal.OUTSIDE, Refusal.JUMP, Refusal.SPEED, Refusal.ACCELERATION})


def _garbage(row: int, spoil: Callable[[Segment, Random], Segment], *refusals: Refusal) -> Garbage:
    return Garbage(row, frozenset(refusals), _fresh(spoil))


GARBAGE = {
    'NaN in a segment': _garbage(8, _not_a_number, Refusal.NOT_FINITE),
    'infinity in a segment': _garbage(8, _infinite, Refusal.NOT_FINITE),
    'huge value in a segment': _garbage(8, _huge, *ANY),
    'segment leaves the plane': _garbage(9, _outside, Refusal.OUTSIDE),
    'segment leaves the height of the plane': _garbage(9, _off_height, Refusal.SHAPE),
    'segment starts elsewhere': _garbage(10, _elsewhere, Refusal.START_POSITION),
    'segment starts with another velocity': _garbage(
        10, _other_velocity, Refusal.START_VELOCITY, Refusal.LATE
    ),
    'step in a segment': _garbage(10, _step, *MOVES),
    'segment too fast': _garbage(10, _fast, *MOVES),
    'segment accelerates too much': _garbage(10, _hard, *MOVES),
    'old segment': Garbage(11, frozenset({Refusal.STALE}), _old),
    'segment sent again': _garbage(12, _again, Refusal.DUPLICATE),
    'segment overtaken': _garbage(12, _earlier, Refusal.OUT_OF_ORDER),
    'empty segment': _garbage(13, _points(0), Refusal.KNOTS),
    'segment of one point': _garbage(13, _points(1), Refusal.KNOTS),
    'segment of 100 000 points': _garbage(13, _points(MANY), Refusal.KNOTS),
    'times of a segment do not increase': _garbage(13, _timeless, Refusal.TIMES),
    'segment in another frame': _garbage(13, _lost_in_space, Refusal.FRAME),
    'arrays of a segment do not fit': _garbage(13, _misshapen, Refusal.SHAPE),
}
"""Ways to spoil a segment, by name; its stamp is one more than that of the last accepted one."""
