# SPDX-License-Identifier: Apache-2.0
"""The same classes in three dimensions: plan, be stopped, learn, plan around: plan_3d.png."""

from matplotlib.figure import Figure
import numpy as np

from srnn_bringup.config_files import NetworkFile
from srnn_bringup.config_lookup import config_directory
from srnn_config import build, read_yaml
from srnn_planner.core.adapter import Learner
from srnn_planner.core.planner import PlanRequest, SegmentPlanner
from srnn_planner.core.retreat import at_rest

PLANS = 10

# Five values differ from the plane: docs/decisions/0024-three-dimensions.md.
file = config_directory() / 'network_3d.yaml'
network = build(NetworkFile, read_yaml(file), str(file))
planner = SegmentPlanner(network.model, network.planning, np.random.default_rng([0, 0]))
learner = Learner(network.model, np.random.default_rng([0, 1]))
here, target = np.array([-0.1, -0.1, 0.0]), np.array([0.4, 0.4, 0.2])  # [m], [units]
print(f'{network.model.network.neurons} neurons in three dimensions')


def plans() -> list[np.ndarray]:
    """Return valid segments (T, 3) [m] from here to the target."""
    request = PlanRequest(here, at_rest(here), target, velocity=0.1, again=True)
    found = [planner.plan(request).trajectory for _ in range(PLANS)]
    return [trajectory.positions for trajectory in found if trajectory is not None]


before = plans()
mental = before[0]
stopped = len(mental) * 2 // 3
executed = mental.copy()
executed[stopped:] = mental[stopped]
lesson = learner.learn(mental, executed)
planner.use_weights(learner.synapses.learned)
after = plans()

for name, segments in (('before', before), ('after', after)):
    near = 1e3 * np.mean([np.linalg.norm(s - mental[-1], axis=1).min() for s in segments])
    print(f'{name}: {len(segments)} valid plans, {near:.0f} mm from the place beyond the touch')

axes = Figure(figsize=(6, 6)).add_subplot(projection='3d')
for segments, colour in ((before, 'tab:orange'), (after, 'tab:blue')):
    for segment in segments:
        axes.plot(*segment.T, color=colour)
axes.plot(*executed[-1], 'x', ms=12, mew=3, color='tab:red')
axes.set(xlabel='x [m]', ylabel='y [m]', zlabel='z [m]', title='orange: before; blue: after')
axes.figure.savefig('plan_3d.png')
