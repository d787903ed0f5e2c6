# SPDX-License-Identifier: Apache-2.0
"""A point that follows plans in two or three dimensions, and stops at a ball in its way."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scale_setting import VELOCITY, Setting

from srnn_planner.core.adapter import Learner
from srnn_planner.core.planner import PlanRequest, SegmentPlanner
from srnn_planner.core.retreat import Trail, at_rest
from srnn_planner.core.trajectory import Trajectory

REACH = 0.06
"""A way point is reached when the point is so close to it [m]."""

TOOL = 0.012
"""Radius of the point [m]."""

NOISE = 0.0004
"""Deviation from the plan along each axis [m]."""

APART = 0.17
"""Least distance between way points [m]."""

ROOM = 0.03
"""Least distance between ball and tool at a way point [m]."""

INNER = 0.75
"""Way points lie within this share of the workspace along each axis."""

WAYPOINTS = 3
RETREATS = 4
"""The way back grows with every contact in a row, up to so many times the first."""


@dataclass(frozen=True, eq=False)
class BallScene:
    """Way points (3, d) in a circle, and a ball on the way from the first to the second [m]."""

    waypoints: NDArray[np.float64]
    centre: NDArray[np.float64]
    radius: float


@dataclass
class Trial:
    """What came of a trial.

    Attributes:
        reached: way points that were reached.
        behind: how often the one behind the ball was.
        touched: numbers of the segments that ended at the ball.
        updates: how often something was learned.
        invalid: plans that were none.
        covered: distance between the ends of the segments that did not touch [m].

    """

    reached: int
    behind: int
    touched: list[int]
    updates: int
    invalid: int
    covered: list[float]


def random_scene(dimensions: int, half_extent: float, seed: int) -> BallScene:
    """Return the scene of a seed."""
    rng = np.random.default_rng([seed, dimensions])
    while True:
        edge = INNER * half_extent
        waypoints = rng.uniform(-edge, edge, (WAYPOINTS, dimensions))
        legs = np.linalg.norm(waypoints - np.roll(waypoints, 1, axis=0), axis=1)
        way = waypoints[1] - waypoints[0]
        centre = waypoints[0] + rng.uniform(0.4, 0.6) * way + rng.uniform(-0.01, 0.01, dimensions)
        radius = float(rng.uniform(0.02, 0.035))
        room = np.linalg.norm(waypoints - centre, axis=1).min() - radius - TOOL
        if legs.min() > APART and room > ROOM:
            return BallScene(waypoints, centre, radius)


def run(given: Setting, scene: BallScene, segments: int, seed: int) -> Trial:
    """Go from way point to way point for so many plans, and learn from every segment."""
    rng = np.random.default_rng([seed, 2])
    planner = SegmentPlanner(given.model, given.planning, np.random.default_rng([seed, 0]))
    learner = Learner(given.model, np.random.default_rng([seed, 1]))
    trial, trail, in_a_row = Trial(0, 0, [], 0, 0, []), Trail(), 0
    retreat = given.planning.trajectory.retreat
    to_units, reach = given.model.workspace.to_units, REACH / given.model.workspace.half_extent
    tip, target = scene.waypoints[0], 1
    request = PlanRequest(tip, at_rest(tip), np.zeros(len(tip)), VELOCITY, reach=reach)
    for number in range(segments):
        trajectory = planner.plan(
            replace(request, target=to_units(scene.waypoints[target]))
        ).trajectory
        if trajectory is None:
            trial.invalid += 1
            request = replace(request, joining=at_rest(tip), again=True)
            continue
        planned = _in_time(trajectory)
        executed, touched = _follow(planned, scene, rng)
        trail.extend(executed)
        tip = executed[-1]
        if touched:
            trial.touched.append(number)
            back = trail.back((in_a_row % RETREATS + 1) * retreat)
            request = PlanRequest(tip, at_rest(tip), tip, VELOCITY, back, reach)
            in_a_row += 1
        else:
            trial.covered.append(float(np.linalg.norm(tip - executed[0])))
            request = PlanRequest(tip, trajectory.end, tip, VELOCITY, reach=reach)
            in_a_row = 0
        if learner.learn(planned, executed).updated:
            planner.use_weights(learner.synapses.learned)
        if np.linalg.norm(tip - scene.waypoints[target]) < REACH:
            trial.reached += 1
            trial.behind += target == 1
            target = (target + 1) % WAYPOINTS
    trial.updates = learner.updates
    return trial


def _in_time(trajectory: Trajectory) -> NDArray[np.float64]:
    """Return positions (T, d) at times that are evenly spaced [m]."""
    when = np.linspace(0.0, trajectory.duration, len(trajectory.times))
    columns = [np.interp(when, trajectory.times, column) for column in trajectory.positions.T]
    return np.column_stack(columns)


def _follow(
    planned: NDArray[np.float64], scene: BallScene, rng: np.random.Generator
) -> tuple[NDArray[np.float64], bool]:
    """Return what the point does of a plan (T, d), held before the ball, and if it touches."""
    executed = planned + NOISE * rng.standard_normal(planned.shape)
    inside = np.linalg.norm(executed - scene.centre, axis=1) < scene.radius + TOOL
    if inside.any():
        last = max(int(np.argmax(inside)) - 1, 0)
        executed[last:] = executed[last]
    return executed, bool(inside.any())
