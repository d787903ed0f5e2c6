# SPDX-License-Identifier: Apache-2.0
"""An obstacle world of your own, learned by touch in seconds: world.png.

A scene is plain data; as a YAML file it is what `srnn demo --scene FILE` takes.
"""

from dataclasses import replace
import sys

from matplotlib.figure import Figure
from matplotlib.patches import Polygon
import numpy as np

from srnn_config.geometry import outline
from srnn_config.scene import build_scene
from srnn_experiments.agent import Brain
from srnn_experiments.setting import Setting
from srnn_experiments.trial import run_trial
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

SEGMENTS = int(sys.argv[1]) if len(sys.argv) > 1 else 120

scene = build_scene(
    {
        'name': 'gate',
        'waypoints': [[-0.15, 0.0], [0.15, 0.0]],
        'obstacles': [
            {'shape': 'disc', 'center': [0.0, 0.05], 'radius': 0.04},
            {'shape': 'box', 'center': [0.0, -0.06], 'size': [0.04, 0.08], 'yaw': 0.3},
        ],
    },
    where='own_world.py',
)
brain = Brain(ModelParameters(), PlanningParameters())
# A point in place of the arm; world='mujoco' runs the same trial on the simulated arm.
setting = Setting(scene, brain, SEGMENTS, world='point')
outcome = run_trial(setting, seed=0)
told = run_trial(replace(setting, agent='oracle'), seed=0)

third = SEGMENTS // 3
touches = np.array([record.touched for record in outcome.records])
thirds = np.split(touches, [third, 2 * third])
print(f'touches in each third: {[int(part.sum()) for part in thirds]}')
print(f'laps: {outcome.figures["laps"]}, told of the obstacles: {told.figures["laps"]}')

axes = Figure(figsize=(6, 6)).add_subplot(aspect='equal')
for obstacle in scene.obstacles:
    axes.add_patch(Polygon(outline(obstacle), color='lightgrey'))
for record in outcome.records:
    late = record.number > 2 * third
    axes.plot(*record.executed.positions[:, :2].T, color='tab:blue' if late else 'tab:orange')
axes.set(xlim=(-0.3, 0.3), ylim=(-0.3, 0.3), title='orange: learning; blue: the last third')
axes.figure.savefig('world.png')
