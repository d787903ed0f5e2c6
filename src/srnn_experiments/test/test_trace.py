# SPDX-License-Identifier: Apache-2.0
"""What a trial leaves behind on request: complete, consistent, and without any influence."""

import numpy as np
import pytest

from srnn_config.scene import Obstacle, Scene, SceneTask
from srnn_experiments.agent import Brain
from srnn_experiments.campaign import Job, do
from srnn_experiments.setting import Setting
from srnn_experiments.store import unpack
from srnn_planner.core.dissonance import within_horizon
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.state_neurons import StateNeurons

POINTS = ((-0.15, -0.1), (0.15, -0.1))
SCENE = Scene(
    SceneTask(name='wall', blocked=1), POINTS,
    (Obstacle('box', (0.0, -0.1), size=(0.03, 0.12)),), start=POINTS[0],
)  # fmt: skip
BRAIN = Brain(ModelParameters(), PlanningParameters())
LEARNING = BRAIN.model.learning
SEGMENTS = 20
MEASURED = ('planning_ms', 'update_ms', 'wall_s')
KEEP = frozenset({'change', 'paths', 'trace', 'weights'})
SIGNALS = ('none', 'global', 'local', 'constant', 'untriggered')


def setting(signal):
    return Setting(SCENE, BRAIN, SEGMENTS, 'point').with_signal(signal)


@pytest.fixture(scope='module')
def trials():
    return {signal: do(Job(setting(signal), 3, KEEP)) for signal in SIGNALS}


def test_what_is_kept_changes_no_trial(trials):
    for signal, trial in trials.items():
        plain = do(Job(setting(signal), 3))
        for key in set(plain) - set(MEASURED):
            assert trial[key] == plain[key], key
        assert set(trial) - set(plain) == KEEP


def test_what_is_kept_is_part_of_the_identity_of_a_job():
    keys = {Job(setting('none'), 3, keep).key for keep in (set(), {'trace'}, KEEP)}
    assert len(keys) == 3


def test_a_trace_agrees_with_the_figures_of_its_trial(trials):
    for trial in trials.values():
        trace = trial['trace']
        columns = {name: values for name, values in trace.items() if name != 'signals'}
        assert {len(values) for values in columns.values()} == {trial['segments_executed']}
        assert sum(trace['updated']) == trial['updates_triggered']
        assert sum(trace['reached']) == trial['waypoints_reached']
        touches = [number for number, on in enumerate(trace['touched'], 1) if on]
        assert touches == trial['contact_segments']
        assert (np.diff(trace['invalid_plans'], prepend=0) >= 0).all()
        assert trace['invalid_plans'][-1] <= trial['invalid_plans']


@pytest.mark.parametrize(
    ('signal', 'peak', 'threshold'),
    [
        ('global', 'global_peak', LEARNING.global_threshold),
        ('constant', 'global_peak', LEARNING.global_threshold),
        ('local', 'local_peak', LEARNING.local_threshold),
    ],
)
def test_a_segment_updates_when_its_dissonance_exceeds_the_threshold(
    trials, signal, peak, threshold
):
    trace = trials[signal]['trace']
    assert trace['updated'] == [value > threshold for value in trace[peak]]
    assert any(trace['updated'])


def test_untriggered_learning_updates_always_and_no_learning_never(trials):
    assert all(trials['untriggered']['trace']['updated'])
    assert not any(trials['none']['trace']['updated'])
    assert not np.any(trials['none']['change']['input'])


def test_signals_that_are_used_lie_between_threshold_and_limit(trials):
    for signal, threshold in (
        ('global', LEARNING.global_threshold), ('local', LEARNING.local_threshold),
    ):  # fmt: skip
        used = np.array(trials[signal]['trace']['signals'])
        assert ((used >= threshold) & (used <= LEARNING.limit)).all()
        assert len(used) >= trials[signal]['updates_triggered'] > 0
        peaks = np.minimum(trials[signal]['trace'][f'{signal}_peak'], LEARNING.limit)
        assert used.max() == pytest.approx(max(peaks))
    for signal in ('none', 'constant', 'untriggered'):
        assert trials[signal]['trace']['signals'] == []


def test_the_change_is_that_of_the_weights(trials):
    neurons = StateNeurons(BRAIN.model.network)
    for trial in trials.values():
        synapses = neurons.synapses(unpack(trial['weights']))
        change = synapses.dense().astype(np.float64) - neurons.prior_weights
        assert trial['change']['input'] == pytest.approx(change.mean(axis=0), abs=1e-8)
        assert trial['change']['output'] == pytest.approx(change.mean(axis=1), abs=1e-8)


def test_paths_hold_plan_and_execution_of_every_segment(trials):
    trial = trials['local']
    paths = trial['paths']
    assert {len(values) for values in paths.values()} == {SEGMENTS}
    extent = BRAIN.model.workspace.half_extent
    for number in range(SEGMENTS):
        plan, executed = (np.array(paths[kind][number]) for kind in ('plans', 'executed'))
        assert plan.shape == executed.shape == (len(paths['times'][number]), 2)
        length = np.linalg.norm(np.diff(plan, axis=0), axis=1).sum()
        assert length == pytest.approx(trial['trace']['planned_m'][number], abs=1e-3)
        believed = within_horizon(plan / extent, executed / extent, BRAIN.model.learning.horizon)
        distance = np.linalg.norm(believed - executed / extent, axis=1).max()
        assert distance**2 == pytest.approx(trial['trace']['global_peak'][number], abs=1e-3)
