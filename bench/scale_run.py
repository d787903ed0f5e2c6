# SPDX-License-Identifier: Apache-2.0
"""Measures one size of the network, in a process of its own with a bound on its memory.

`bench/scale.py` starts it; what it prints is JSON.
"""

import argparse
from dataclasses import asdict, dataclass
import gc
import json
import os
from pathlib import Path
import re
import resource
import subprocess
import sys
from time import thread_time
from typing import Any, NamedTuple

import numpy as np
from rclpy.serialization import serialize_message
from scale_setting import Case, Setting, fan_out, setting
from threadpoolctl import threadpool_limits
from timing import times_ms

from srnn_msgs_py.ros.weights import to_msg
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core.adapter import Learner
from srnn_planner.core.planner import Plan, PlanRequest, SegmentPlanner

SMALLEST = 7
"""Neurons a side of the network whose kernels are loaded before memory is measured."""

LOOKS = 20
"""Segments that are looked at, of either target."""

GIB = 2**30
STATUS, PEAK = Path('/proc/self/status'), Path('/proc/self/clear_refs')
RESET_PEAK = '5'


@dataclass(frozen=True)
class Times:
    """What one process has timed, on its processor, and seen.

    Attributes:
        plan_ms: planning with the target near, p50.
        across_ms: planning with the target half-way to the edge, p50.
        update_ms: learning from a touch, p50.
        take_ms: taking the learned weights over into the planner, p50.
        spikes: of a segment, all samples together.
        fan_out: synapses of a neuron that differ from those of distant ones.
        valid: share of the samples that are valid, target near.
        valid_across: the same, target half-way to the edge.
        pace: way to the near target that one segment covers [neurons].
        pace_across: the same, target half-way to the edge.
        wire_bytes: length of the message of the learned weights.

    """

    plan_ms: float
    across_ms: float
    update_ms: float
    take_ms: float
    spikes: float
    fan_out: int
    valid: float
    valid_across: float
    pace: float
    pace_across: float
    wire_bytes: int


class Network:
    """Planner and learner of a setting, with what one touch has taught."""

    def __init__(self, given: Setting) -> None:
        """Build both, and let them learn, hand over and plan once."""
        self.setting = given
        self.planner = SegmentPlanner(given.model, given.planning, np.random.default_rng(3))
        self.learner = Learner(given.model, np.random.default_rng(4))
        self.learner.learn(*given.touch())
        self.take()
        self.planner.plan(given.near())

    def learn(self) -> None:
        """Learn from a touch."""
        self.learner.learn(*self.setting.touch())

    def take(self) -> None:
        """Plan with the learned weights from now on."""
        self.planner.use_weights(self.learner.synapses.learned)


def wire_bytes(learner: Learner) -> int:
    """Return the length of the message that carries the learned weights."""
    return len(serialize_message(to_msg(WeightsUpdate(1, 1, learner.synapses.learned))))


class Movement(NamedTuple):
    """What a plan is made of.

    Attributes:
        spikes: of all samples together.
        valid: share of the samples that have neither died nor jumped.
        pace: by how much its end is nearer to the target than its beginning [neurons].

    """

    spikes: float
    valid: float
    pace: float


def movement(given: Setting, request: PlanRequest, plan: Plan) -> Movement:
    """Look at a plan."""
    # The path of a sample that dies falls back to the middle of the workspace: it jumps.
    jumps = np.linalg.norm(np.diff(plan.samples, axis=1), axis=2).max(axis=1)
    here = given.model.workspace.to_units(request.measured)
    # Nothing is kept of a plan that is not valid, and the arm stays where it is.
    end = plan.samples[plan.kept, -1].mean(axis=0) if plan.kept.any() else here
    nearer = np.linalg.norm(request.target - here) - np.linalg.norm(request.target - end)
    return Movement(
        float(plan.spikes.sum()),
        float((jumps <= given.planning.sampling.step_max).mean()),
        float(nearer / given.spacing),
    )


def looks(network: Network, *requests: PlanRequest) -> list[Movement]:
    """Return for each request the means over some plans.

    Requests take turns: who plans for one target again and again is told to have got nowhere.
    """
    seen = [
        [movement(network.setting, request, network.planner.plan(request)) for request in requests]
        for _ in range(LOOKS)
    ]
    return [Movement(*means) for means in np.mean(seen, axis=0).tolist()]


def times(case: Case, repeats: int) -> Times:
    """Measure how long a case takes."""
    given = setting(case)
    network = Network(given)
    near, across = given.near(), given.across()
    wire = wire_bytes(network.learner)
    to_near, to_far = looks(network, near, across)
    with threadpool_limits(1):
        plan, far, update, take = times_ms(
            lambda: network.planner.plan(near), lambda: network.planner.plan(across),
            network.learn, network.take, repeats=repeats, clock=thread_time,
        )  # fmt: skip
    return Times(
        plan.p50, far.p50, update.p50, take.p50, to_near.spikes,
        fan_out(given.model.network), to_near.valid, to_far.valid, to_near.pace, to_far.pace, wire,
    )  # fmt: skip


def memory(case: Case) -> int:
    """Return the peak of resident memory beyond that of a tiny network [bytes].

    `ru_maxrss` cannot be set back after what loading the kernels has taken for a while; the
    kernel's own mark in `/proc` can.
    """
    Network(setting(Case(case.dimensions, SMALLEST)))
    gc.collect()
    PEAK.write_text(RESET_PEAK)
    before = _resident('VmRSS')
    network = Network(setting(case))
    network.learn()
    network.take()
    return _resident('VmHWM') - before


def _resident(key: str) -> int:
    found = re.search(rf'{key}:\s+(\d+) kB', STATUS.read_text())
    assert found is not None
    return 1024 * int(found[1])


@dataclass(frozen=True)
class Measured:
    """A case and what was found; None where its memory did not suffice."""

    case: Case
    times: Times | None
    memory: int | None


def measure(case: Case, repeats: int, limit_gib: float) -> Measured:
    """Measure a case in two processes: what frees memory at once takes longer."""
    found = _child(case, 'times', repeats, limit_gib, {})
    at_once = {'MALLOC_MMAP_THRESHOLD_': str(2**16)}
    peak = _child(case, 'memory', repeats, limit_gib, at_once) if found else None
    return Measured(case, Times(**found) if found else None, peak)


def _child(
    case: Case, what: str, repeats: int, limit_gib: float, environment: dict[str, str]
) -> Any:
    words = [f'{key}={value}' for key, value in asdict(case).items()]
    done = subprocess.run(
        [sys.executable, __file__, what, str(repeats), str(limit_gib), *words],
        stdout=subprocess.PIPE, env={**os.environ, **environment}, check=True,
    )  # fmt: skip
    return json.loads(done.stdout)


def main() -> None:
    """Measure what the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('what', choices=('times', 'memory'))
    parser.add_argument('repeats', type=int)
    parser.add_argument('limit_gib', type=float)
    parser.add_argument('case', nargs='+', metavar='KEY=VALUE')
    options = parser.parse_args()
    pairs = (word.split('=') for word in options.case)
    case = Case(**{key: int(value) for key, value in pairs})
    limit = round(options.limit_gib * GIB)
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    try:
        found = (
            asdict(times(case, options.repeats)) if options.what == 'times' else memory(case)
        )
    except MemoryError:
        found = None
    print(json.dumps(found))


if __name__ == '__main__':
    main()
