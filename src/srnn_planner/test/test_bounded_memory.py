# SPDX-License-Identifier: Apache-2.0
"""A planner and an adapter that run for days need no more memory than after an hour."""

from collections.abc import Callable
from dataclasses import replace
import gc
import tracemalloc

from dense_weights import every
from lessons import learned_model
import numpy as np
import pytest

from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core.model_watch import ModelWatch
from srnn_planner.core.pairing import Pairing
from srnn_planner.core.parameters import (
    ModelParameters,
    NetworkParameters,
    PlanningParameters,
    ScheduleParameters,
)
from srnn_planner.core.planner import TARGETS_KEPT, PlanRequest, SegmentPlanner
from srnn_planner.core.retreat import at_rest
from srnn_planner.core.sequencer import Sequencer
from srnn_planner.core.statistics import Durations
from srnn_planner.core.task import WaypointTask
from srnn_planner.core.trajectory import Motion, time_path
from srnn_planner.core.workspace import Workspace

EVENTS = 100_000
FILLED = 12_000
"""Events after which whatever is bounded is full."""

GROWTH = 64_000
"""One number kept of every event would be more than this [bytes]."""


def growth(event: Callable[[int], object], events: int = EVENTS) -> int:
    """Return by how much memory grows over many events [bytes]."""
    tracemalloc.start()
    try:
        for n in range(FILLED):
            event(n)
        gc.collect()
        before = tracemalloc.get_traced_memory()[0]
        for n in range(FILLED, FILLED + events):
            event(n)
        gc.collect()
        return tracemalloc.get_traced_memory()[0] - before
    finally:
        tracemalloc.stop()


def test_the_measure_sees_what_is_kept():
    kept = []
    assert growth(kept.append) > GROWTH


def test_segments_and_paths_that_never_meet_are_forgotten():
    pairing, times = Pairing(), np.zeros(4)
    zeros = np.zeros((4, 2))

    def event(n):
        if n % 3:
            assert pairing.segment(Segment(2 * n, times, zeros, zeros, zeros)) is None
        else:
            assert pairing.executed(ExecutedPath(2 * n + 1, times, zeros.copy())) is None

    assert growth(event) < GROWTH


@pytest.mark.slow
def test_the_sequencer_forgets_what_is_over():
    # Statistics over few planning times, because they take most of the time here.
    schedule = ScheduleParameters(window=2)
    planning = replace(PlanningParameters(), schedule=schedule)
    task = WaypointTask(np.array([[0.5, 0.0], [-0.5, 0.0]]), 0.2)
    sequencer = Sequencer(task, Workspace(), planning, 0.1)
    rest = Motion(np.zeros(2), np.zeros(2))
    straight = time_path(np.linspace([0, 0], [0.1, 0.0], 30), rest, 0.1, planning.trajectory)
    codes = [code for code in ResultCode if code is not ResultCode.BLOCKED]
    sequencer.executed(1, np.zeros((1, 2)))

    def event(n):
        now = 2.0 * n
        sequencer.tip(np.array([0.1 * (n % 2), 0.0]))
        if sequencer.request(now) is None:
            return
        if n % 7 == 0:
            sequencer.failed(0.01, now)
            return
        sequencer.sent(n, straight, 0.01, now)
        if n % 5:
            sequencer.executed(n, straight.positions[:3])
            sequencer.learned(n)
        code = codes[n % len(codes)] if n % 50 else ResultCode.BLOCKED
        sequencer.result(SegmentResult(n, code), now + 1.0)

    assert growth(event) < GROWTH
    assert sequencer.counters.planned > EVENTS / 2
    assert sequencer.counters.lost == 0


def test_statistics_keep_the_last_durations_only():
    durations = Durations()
    assert growth(lambda n: durations.record(1e-3 * n)) < GROWTH
    assert durations.last == 1e-3 * (FILLED + EVENTS - 1)


def test_the_watch_keeps_a_few_good_versions():
    watch = ModelWatch(every(np.zeros((3, 3), np.float32)), 2)

    def event(n):
        content = np.full((3, 3), (n % 1000) / 1000.0, np.float32)
        update = WeightsUpdate(n + 1, n, every(content))
        watch.check(update)
        watch.take(update)
        watch.planned() if n % 3 else watch.failed()

    assert growth(event) < GROWTH


def test_the_history_and_the_way_back_are_bounded():
    model = learned_model()
    assert growth(model.revert, EVENTS // 10) < GROWTH


def test_the_planner_remembers_so_many_way_points_only():
    network = NetworkParameters(neurons_per_dimension=5, sigma=0.3)
    planner = SegmentPlanner(
        ModelParameters(network=network), PlanningParameters(), np.random.default_rng(1)
    )
    here = np.zeros(2)
    for n in range(TARGETS_KEPT + 20):
        planner.plan(PlanRequest(here, at_rest(here), np.array([0.5, n / 1000.0]), 0.1))
        assert len(planner._centres) == min(n + 1, TARGETS_KEPT)
