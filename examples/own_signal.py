# SPDX-License-Identifier: Apache-2.0
"""A dissonance signal of your own, at work beside those of the paper.

This one is local, but counts only what the plan has claimed and the execution denied:
neurons on the way that was not possible.
"""

import sys

import numpy as np
from numpy.typing import NDArray

from srnn_bringup.config_lookup import config_directory
from srnn_config.scene import load_scene
from srnn_experiments.agent import Brain, NetworkAgent
from srnn_experiments.setting import Setting
from srnn_experiments.trial import make_run, make_world
from srnn_planner.core.adapter import Learner
from srnn_planner.core.dissonance import SIGNALS, AbstractSignal, Mismatch
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

SEGMENTS = int(sys.argv[1]) if len(sys.argv) > 1 else 120


class DeniedSignal(AbstractSignal):
    """alpha_ti = c max(0, omega_m - omega_e)^2: what was imagined and did not happen."""

    def rates(self, mismatch: Mismatch) -> NDArray[np.float64]:
        """Return alpha (T, n); below the threshold nothing is learned."""
        denied = np.maximum(mismatch.mental - mismatch.executed, 0.0)
        alpha = self._p.local_scale * denied**2
        return np.where(alpha > self._p.local_threshold, np.minimum(alpha, self._p.limit), 0.0)


brain = Brain(ModelParameters(), PlanningParameters())
scene = load_scene(config_directory() / 'scenes' / 'four_waypoints.yaml')
setting = Setting(scene, brain, SEGMENTS, world='point')
print(f'{SEGMENTS} segments     touches  updates  laps')
for signal in (SIGNALS['none'], SIGNALS['global'], SIGNALS['local'], DeniedSignal):
    agent = NetworkAgent(brain, seed=0)
    # A learner takes any signal. For a name that `--signal` knows: docs/tutorial.md, step 3.
    agent.learner = Learner(
        brain.model, np.random.default_rng([0, 1]), signal(brain.model.learning)
    )
    run = make_run(setting, make_world(setting, seed=0), agent)
    records = run.run(SEGMENTS)
    touches = sum(record.touched for record in records)
    print(f'{signal.__name__:16} {touches:7} {agent.learner.updates:8} '
          f'{run.sequencer.task.laps:5}')
