# SPDX-License-Identifier: Apache-2.0
"""Plan one segment and draw what was imagined for it: plan.png."""

from matplotlib.figure import Figure
import numpy as np

from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planner import PlanRequest, SegmentPlanner
from srnn_planner.core.retreat import at_rest

# Two frames: the arm is in metres, the network in units. Here 1 unit is 0.3 m.
model, planning = ModelParameters(), PlanningParameters()
planner = SegmentPlanner(model, planning, np.random.default_rng(seed=0))

here = np.array([-0.15, -0.10])  # [m]
target = model.workspace.to_units(np.array([0.15, 0.10]))
plan = planner.plan(PlanRequest(here, at_rest(here), target, velocity=0.1))

# No trajectory: fewer than half of the samples were movements (valid_share).
if plan.trajectory is None:
    raise SystemExit('no valid plan')

samples = model.workspace.to_metres(plan.samples)  # (S, T, d)
segment = plan.trajectory.positions  # (T, d) [m]
print(f'{len(samples)} movements imagined, {plan.kept.sum()} of one kind averaged')
print(f'a segment of {plan.trajectory.duration:.2f} s, {len(segment)} knots, '
      f'from {segment[0].round(3)} to {segment[-1].round(3)} m')

axes = Figure(figsize=(6, 6)).add_subplot(aspect='equal')
for sample, kept in zip(samples, plan.kept, strict=True):
    axes.plot(*sample.T, color='tab:green' if kept else 'lightgrey', zorder=1 + kept)
axes.plot(*segment.T, color='tab:blue', lw=3, zorder=3, label='segment')
axes.plot(*model.workspace.to_metres(target), 'o', ms=12, color='tab:orange', label='way point')
axes.set(xlim=(-0.3, 0.3), ylim=(-0.3, 0.3), xlabel='x [m]', ylabel='y [m]')
axes.legend()
axes.figure.savefig('plan.png')
