# SPDX-License-Identifier: Apache-2.0
"""Row 22, the other side: where nothing stands in the way, nothing stops a badly known arm."""

from dataclasses import replace
from pathlib import Path

from fault_ledger import FaultLedger
from moving_arm import generator
import numpy as np
import pytest

from lwr_sim_bridge.parameters import ArmParameters, MismatchParameters
from srnn_config.scene import Scene, load_scene
from srnn_experiments.agent import Brain
from srnn_experiments.setting import Setting
from srnn_experiments.trial import make_agent, make_run, make_world
from srnn_msgs_py.result import ResultCode
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

SCENE = load_scene(Path(__file__).parents[2] / 'config' / 'scenes' / 'four_waypoints.yaml')
RUNS = 10
LONGEST = 20.0
"""No segment takes longer than this [s]."""


def free_scene(rng: np.random.Generator) -> Scene:
    task = replace(SCENE.task, velocity=rng.uniform(0.05, 0.2))
    return replace(SCENE, task=task, obstacles=())


def badly_known(run: int) -> ArmParameters:
    """Return an arm that is a tenth lighter or heavier, carries 0.2 kg more and rubs."""
    mismatch = MismatchParameters(
        mass_scale=(0.9, 1.1)[run % 2], payload=0.2, friction=(0.5,) * 7
    )
    return ArmParameters(mismatch=mismatch)


def as_configured(run: int) -> ArmParameters:
    """Return the arm with the mismatch and the noise of the configuration."""
    return ArmParameters()


ARMS = {'a badly known arm': badly_known, 'the arm as configured': as_configured}


def runs_free(ledger: FaultLedger, kind: str, run: int, segments: int) -> None:
    """Let the planner move the arm through an empty plane for so many segments."""
    what = f'{segments} free segments of {kind}'
    brain = Brain(ModelParameters(), PlanningParameters())
    setting = Setting(free_scene(generator(what, run)), brain, segments, arm=ARMS[kind](run))
    setting = setting.with_signal('none')
    with ledger.injection(22, what) as entry:
        world = make_world(setting, run)
        stepped = make_run(setting, world, make_agent(setting, run))
        tips = []
        while len(stepped.records) < segments:
            assert world.time < LONGEST * (1 + len(stepped.records))
            stepped.cycle()
            tips.append(world.arm.tip_truth)
        assert {record.result.code for record in stepped.records} == {ResultCode.DONE}
        counters = world.tracker.counters
        assert (counters.contacts, counters.yields, counters.faults) == (0, 0, 0)
        assert not world.arm.data.warning.number.any()
        away = [record.executed.positions - record.plan.positions for record in stepped.records]
        entry.deviation_mm = 1e3 * np.hypot(*np.concatenate(away).T).max()
        entry.speed = np.linalg.norm(np.diff(tips, axis=0), axis=1).max() / 0.004
        assert entry.deviation_mm <= 4.0
        # The gate admits plans of up to 0.25 m/s, which the arm overshoots a little.
        assert entry.speed <= 0.27


@pytest.mark.parametrize('kind', ARMS)
@pytest.mark.parametrize('run', range(RUNS))
def test_nothing_stops_an_arm_that_touches_nothing(ledger, kind, run):
    runs_free(ledger, kind, run, 10)


@pytest.mark.slow
@pytest.mark.parametrize('kind', ARMS)
@pytest.mark.parametrize('run', range(RUNS))
def test_nothing_stops_it_in_3000_segments(ledger, kind, run):
    """Fewer where faults are injected less often than 20 times."""
    runs_free(ledger, kind, run, min(15 * ledger.repeats, 300))
