# SPDX-License-Identifier: Apache-2.0
"""Draws how ten segments join: tip position, tip velocity and commanded joints over time.

Run: .venv/bin/python bench/segment_joints.py docs/segment_joints.png
"""

from dataclasses import replace
from pathlib import Path
import sys

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np

from lwr_description import JOINT_NAMES
from lwr_tracking.core.parameters import TrackerParameters
from srnn_config.scene import load_scene
from srnn_experiments.agent import Brain
from srnn_experiments.mujoco_world import MujocoWorld
from srnn_experiments.setting import Setting
from srnn_experiments.trial import make_agent, make_run, make_world
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

ROOT = Path(__file__).parents[1]
SEGMENTS = 10


def record(seed: int = 4) -> tuple[dict[str, np.ndarray], list[float]]:
    """Run the standard scene without its obstacle on simulated time.

    Returns:
        The signals by name, (n, columns) each, and the times at which segments join [s].

    """
    scene = replace(load_scene(ROOT / 'config/scenes/four_waypoints.yaml'), obstacles=())
    setting = Setting(scene, Brain(ModelParameters(), PlanningParameters()), SEGMENTS)
    world = make_world(setting, seed)
    assert isinstance(world, MujocoWorld)
    run = make_run(setting, world, make_agent(setting, seed))
    rows, joints, ended = [], [], 0
    while len(run.records) < SEGMENTS:
        run.cycle()
        reference = world.tracker.reference
        if reference is None or world.command is None:
            continue
        rows.append(
            np.concatenate(
                [[world.arm.time], reference.position[:2], world.tracker.tip[:2],
                 reference.velocity[:2], world.command]
            )
        )  # fmt: skip
        if len(run.records) > ended:
            ended = len(run.records)
            joints.append(world.arm.time)
    table = np.array(rows)
    columns = {'t': slice(0, 1), 'reference': slice(1, 3), 'measured': slice(3, 5),
               'velocity': slice(5, 7), 'command': slice(7, 14)}  # fmt: skip
    return {name: table[:, part] for name, part in columns.items()}, joints


def draw(signals: dict[str, np.ndarray], joints: list[float], path: Path) -> None:
    """Write the picture."""
    t = signals['t'][:, 0]
    figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(11, 8), sharex=True)
    for axis, colour, name in zip((0, 1), ('#1f6f8b', '#e07a30'), 'xy', strict=True):
        top.plot(t, 1e3 * signals['measured'][:, axis], color=colour, lw=3, alpha=0.3)
        top.plot(t, 1e3 * signals['reference'][:, axis], color=colour, lw=1.2, label=name)
        middle.plot(t, signals['velocity'][:, axis], color=colour, lw=1.2, label=name)
    speed = np.linalg.norm(signals['velocity'], axis=1)
    middle.plot(t, speed, color='0.3', lw=1.0, ls='--', label='speed')
    for index, name in enumerate(JOINT_NAMES):
        bottom.plot(t, np.degrees(signals['command'][:, index] - signals['command'][0, index]),
                    lw=1.2, label=name.removeprefix('lwr_').removesuffix('_joint'))  # fmt: skip
    tracking = TrackerParameters()
    jump = np.linalg.norm(np.diff(signals['velocity'], axis=0), axis=1).max()
    allowed = tracking.gate.acceleration_limit * tracking.period
    top.set_title(
        f'Ten segments, joined on the move: largest step of the velocity {1e3 * jump:.1f} mm/s '
        f'per {1e3 * tracking.period:.0f} ms, allowed {1e3 * allowed:.1f} mm/s',
        fontsize=11,
    )
    top.set_ylabel('tip [mm]\nthin: planned, thick: measured')
    middle.set_ylabel('planned velocity [m/s]')
    bottom.set_ylabel('commanded joints,\nchange since start [deg]')
    bottom.set_xlabel('time [s]; dotted lines: one segment ends, the next begins')
    for panel in (top, middle, bottom):
        for joint in joints:
            panel.axvline(joint, color='0.6', lw=0.8, ls=':')
        panel.legend(loc='center left', bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=9)
        panel.spines[['top', 'right']].set_visible(False)
        panel.margins(x=0)
    figure.align_ylabels()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


if __name__ == '__main__':
    draw(*record(), Path(sys.argv[1] if len(sys.argv) > 1 else 'segment_joints.png'))
