# SPDX-License-Identifier: Apache-2.0
"""One trial: a setting and a seed."""

from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np

from srnn_experiments.agent import Agent, NetworkAgent
from srnn_experiments.figures import run_figures
from srnn_experiments.grid_agent import GridAgent
from srnn_experiments.lockstep import LockStep
from srnn_experiments.mujoco_world import MujocoWorld
from srnn_experiments.point_world import PointWorld
from srnn_experiments.segment_record import SegmentRecord
from srnn_experiments.setting import Setting
from srnn_experiments.world import World
from srnn_planner.core.synapses import Synapses


@dataclass(frozen=True, eq=False)
class Outcome:
    """What a trial left behind.

    Attributes:
        figures: plain data for JSON.
        records: its segments.
        synapses: those at its end; None for an agent without a network.
        invalid_plans: how many there were until each segment was over.

    """

    figures: dict[str, Any]
    records: list[SegmentRecord]
    synapses: Synapses | None
    invalid_plans: list[int]


def run_trial(setting: Setting, seed: int) -> Outcome:
    """Run one trial; equal arguments give equal decisions, bit for bit."""
    began = perf_counter()
    agent = make_agent(setting, seed)
    world = make_world(setting, seed)
    run = make_run(setting, world, agent)
    counters = run.sequencer.counters
    records, invalid_plans = run.records, list[int]()
    while len(records) < setting.segments:
        run.run(len(records) + 1)
        new = len(records) - len(invalid_plans)
        if not new:
            break
        invalid_plans += [counters.invalid_plans] * new
    figures = {
        'seed': seed,
        **run_figures(records, setting.scene.task.blocked),
        'invalid_plans': counters.invalid_plans,
        'deadline_misses': counters.deadline_misses,
        'contact_force_peak_n': world.force_peak,
        'simulated_s': world.time,
        'wall_s': perf_counter() - began,
    }
    synapses = agent.learner.synapses if isinstance(agent, NetworkAgent) else None
    return Outcome(figures, records, synapses, invalid_plans)


def make_run(setting: Setting, world: World, agent: Agent) -> LockStep:
    """Return the run of an agent in a world."""
    workspace = setting.brain.model.workspace
    return LockStep(setting.scene, world, agent, setting.brain.planning, workspace)


def make_world(setting: Setting, seed: int) -> World:
    """Return the world of a setting, with random numbers of its own."""
    rng = np.random.default_rng([seed, 2])
    if setting.world == 'point':
        return PointWorld(setting.scene, rng, setting.mount, setting.tracking)
    return MujocoWorld(setting.scene, rng, setting.mount, setting.tracking, setting.arm)


def make_agent(setting: Setting, seed: int) -> Agent:
    """Return who plans in a setting."""
    if setting.agent == 'grid':
        return GridAgent(setting.brain)
    oracle = setting.agent == 'oracle'
    known = tuple(o for o in setting.scene.obstacles if o.known or oracle)
    return NetworkAgent(setting.brain, seed, known, setting.weights)
