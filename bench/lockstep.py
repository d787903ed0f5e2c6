# SPDX-License-Identifier: Apache-2.0
"""How much faster than real time the whole system runs on simulated time, on one core.

Run: .venv/bin/python bench/lockstep.py [SEGMENTS]
"""

from pathlib import Path
import sys

from threadpoolctl import threadpool_limits

from srnn_config.scene import load_scene
from srnn_experiments.agent import Brain
from srnn_experiments.choices import WORLDS
from srnn_experiments.setting import Setting
from srnn_experiments.trial import run_trial
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

SCENE = Path(__file__).parents[1] / 'config/scenes/four_waypoints.yaml'


def main() -> None:
    """Print the ratio for both worlds."""
    segments = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    brain = Brain(ModelParameters(), PlanningParameters())
    with threadpool_limits(1):
        for world in WORLDS:
            setting = Setting(load_scene(SCENE), brain, segments, world)
            run_trial(Setting(setting.scene, brain, 1, world), 0)
            figures = run_trial(setting, 0).figures
            simulated = figures['simulated_s']
            ratio = simulated / figures['wall_s']
            print(f'{world:<8} {ratio:5.1f} x real time ({simulated:.0f} s simulated)')


if __name__ == '__main__':
    main()
