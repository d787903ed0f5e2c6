# SPDX-License-Identifier: Apache-2.0
"""Row 12: segments that come twice, late, in another order or not at all."""

from collections.abc import Sequence

from moving_arm import generator
import numpy as np
from perfect_arm import PERIOD, PROMPT, PerfectArm
import pytest
from segments import MS, chain, line, replaced

from lwr_tracking.core.refusal import Refusal
from srnn_msgs_py.result import ResultCode
from srnn_msgs_py.segment import Segment

PER_INJECTION = 13
"""Streams that count as one injection: four faults, 20 times, are the 1000 of the matrix."""

Schedule = dict[int, list[Segment]]
"""What arrives in which tick."""


def identities(rng: np.random.Generator, count: int) -> list[int]:
    """Return increasing identities with gaps."""
    return (MS + np.cumsum(rng.integers(1, 10**9, count))).tolist()


def on_the_move(rng: np.random.Generator) -> list[Segment]:
    """Return segments that join at speed: only its own successor continues one."""
    bends = rng.uniform((0.03, -0.03), (0.06, 0.03), (3, 2))
    return chain(np.cumsum([(0.0, 0.0), *bends], 0), rng.uniform(0.1, 0.2), 0.2, knots=10)


def to_and_fro(rng: np.random.Generator) -> list[Segment]:
    """Return segments between two places: every other one continues one, also older ones."""
    angle, speed = rng.uniform(0.0, 2.0 * np.pi), rng.uniform(0.1, 0.2)
    ends = [(0.0, 0.0), (0.06 * np.cos(angle), 0.06 * np.sin(angle))]
    return [line(*pair, speed) for pair in (ends, ends[::-1]) * 2]


def play(schedule: Schedule, ticks: int) -> tuple[PerfectArm, bytes, Schedule]:
    """Return the arm, its commands, and what was accepted when."""
    arm, commands, accepted = PerfectArm(PROMPT), [], {}
    arm.tick()
    for tick in range(ticks):
        for segment in schedule.get(tick, ()):
            if arm.tracker.offer(segment, 0.0) is None:
                accepted.setdefault(tick, []).append(segment)
        arm.tick()
        commands.append(arm.q.tobytes())
    return arm, b''.join(commands), accepted


def in_time(segments: Sequence[Segment]) -> tuple[Schedule, int]:
    """Return when each segment of a stream is sent: while the one before it runs."""
    begins = np.cumsum([0.0, *(segment.duration for segment in segments)])
    sent = {int(max(begin - 0.1, 0.0) / PERIOD): [segment]
            for begin, segment in zip(begins, segments, strict=False)}  # fmt: skip
    return sent, int(begins[-1] / PERIOD) + 60


def stream(rng: np.random.Generator, make) -> list[Segment]:
    segments = make(rng)
    stamps = identities(rng, len(segments))
    return [replaced(s, stamp_ns=stamp) for s, stamp in zip(segments, stamps, strict=True)]


def top_speed(arm: PerfectArm) -> float:
    return float(np.linalg.norm(arm.velocities, axis=1).max())


@pytest.mark.parametrize('make', [on_the_move, to_and_fro])
def test_what_is_sent_again_changes_nothing(ledger, make):
    """Anything that was sent before may arrive again at any time, and as often."""
    what = f'segments sent again, {make.__name__.replace("_", " ")}'
    for repeat in range(ledger.repeats):
        rng = generator(what, repeat)
        segments = stream(rng, make)
        schedule, ticks = in_time(segments)
        clean, commands, _ = play(schedule, ticks)
        assert [end.result.code for end in clean.finished] == [ResultCode.DONE] * len(segments)
        with ledger.injection(12, what, bound_ms=2.0) as entry:
            for _ in range(PER_INJECTION):
                noisy = {tick: list(sent) for tick, sent in schedule.items()}
                for tick in np.sort(rng.integers(0, ticks, rng.integers(1, 40))).tolist():
                    old = [s for when, sent in schedule.items() if when <= tick for s in sent]
                    noisy.setdefault(tick, []).append(old[rng.integers(len(old))])
                arm, same, accepted = play(noisy, ticks)
                assert same == commands
                assert [s for sent in accepted.values() for s in sent] == segments
                assert set(arm.tracker.counters.refused) <= {
                    Refusal.DUPLICATE, Refusal.OUT_OF_ORDER,
                }  # fmt: skip
            entry.reaction_ms = entry.deviation_mm = 0.0
            entry.speed = top_speed(arm)


@pytest.mark.parametrize('make', [on_the_move, to_and_fro])
def test_only_what_continues_is_executed_whatever_the_order(ledger, make):
    """Executed is what was accepted, once, in the order of its identities, without a gap."""
    what = f'segments shuffled, lost and doubled, {make.__name__.replace("_", " ")}'
    for repeat in range(ledger.repeats):
        rng = generator(what, repeat)
        segments = stream(rng, make)
        _, ticks = in_time(segments)
        # The last two may come at the very end.
        most = ticks + int(2.0 * max(s.duration for s in segments) / PERIOD) + 10
        with ledger.injection(12, what, bound_ms=2.0) as entry:
            entry.deviation_mm = entry.speed = 0.0
            for _ in range(PER_INJECTION):
                arrived = shuffled(segments, rng)
                times = np.sort(rng.integers(0, ticks, len(arrived))).tolist()
                schedule: Schedule = {}
                for tick, segment in zip(times, arrived, strict=True):
                    schedule.setdefault(tick, []).append(segment)
                arm, commands, accepted = play(schedule, most)
                assert commands == play(accepted, most)[1]
                entry.deviation_mm = max(entry.deviation_mm, 1e3 * gap(arm, accepted))
                entry.speed = max(entry.speed, top_speed(arm))
            entry.reaction_ms = 0.0
            assert entry.deviation_mm <= 0.1
            assert entry.speed <= 0.25


def shuffled(segments: Sequence[Segment], rng: np.random.Generator) -> list[Segment]:
    """Return segments out of order, some of them lost, some of them twice."""
    copies = rng.choice([0, 1, 2], len(segments), p=[0.1, 0.6, 0.3])
    sent = np.repeat(np.arange(len(segments)), copies)
    order = np.argsort(sent + rng.uniform(0.0, rng.uniform(0.0, 6.0), len(sent)))
    return [segments[i] for i in sent[order]]


def gap(arm: PerfectArm, accepted: Schedule) -> float:
    """Check what was executed; return the farthest that it is from what was planned [m]."""
    plans = {s.stamp_ns: s for sent in accepted.values() for s in sent}
    assert list(plans) == sorted(plans)
    ends = [end.result for end in arm.finished]
    assert sorted(end.stamp_ns for end in ends) == sorted(plans)
    assert {end.reason for end in ends} <= {'', Refusal.SUPERSEDED}
    farthest, at = 0.0, np.zeros(2)
    for result, path in arm.finished:
        if path is None:
            continue
        plan = plans[result.stamp_ns].positions
        away = np.linalg.norm(np.vstack((path.positions - plan, plan[0] - at)), axis=1)
        farthest, at = max(farthest, away.max()), plan[-1]
    return farthest
