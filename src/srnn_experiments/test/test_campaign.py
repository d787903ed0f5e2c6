# SPDX-License-Identifier: Apache-2.0
"""Many trials: resumed, spread over workers and machines, they stay the same."""

from dataclasses import replace
import os
import signal
import time

import numpy as np
import pytest

from srnn_config.scene import Obstacle, Scene, SceneTask
from srnn_experiments.agent import Brain
from srnn_experiments.campaign import Job, do, rows, run_jobs, trials
from srnn_experiments.errors import ExperimentError, SchedulerError, StoreError
from srnn_experiments.schedulers import DaskCluster, LocalProcesses
from srnn_experiments.setting import Setting
from srnn_experiments.store import TrialStore, pack, unpack
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

POINTS = ((-0.15, -0.1), (0.15, -0.1), (0.0, 0.15))
SCENE = Scene(
    SceneTask(name='here', blocked=1), POINTS,
    (Obstacle('disc', (0.0, -0.1), radius=0.03),), start=POINTS[0],
)  # fmt: skip
SETTING = Setting(SCENE, Brain(ModelParameters(), PlanningParameters()), 12, 'point')
MEASURED = ('planning_ms', 'update_ms', 'wall_s')
"""Times of the machine; everything else is the same wherever a trial is done."""

NO_DASK = 'Dask is not installed'


class Refuses:
    def map(self, jobs):
        assert not jobs, 'nothing was left to do'
        return iter(())


class Dies:
    """Does a few jobs, then is killed."""

    def __init__(self, after):
        self.after = after

    def map(self, jobs):
        for index, job in enumerate(jobs):
            if index == self.after:
                raise KeyboardInterrupt
            yield index, do(job)


def decisions(done):
    return [{k: v for k, v in trial.items() if k not in MEASURED} for trial in done]


@pytest.fixture(scope='module')
def expected():
    return decisions(run_jobs(trials(SETTING, range(4)), LocalProcesses(1), TrialStore()))


def test_seeds_make_a_difference(expected):
    assert [trial['seed'] for trial in expected] == [0, 1, 2, 3]
    assert len({trial['path_length_m'] for trial in expected}) == 4


def test_many_workers_give_what_one_gives(expected):
    found = run_jobs(trials(SETTING, range(4)), LocalProcesses(2), TrialStore())
    assert decisions(found) == expected


def test_a_killed_run_goes_on_where_it_stopped(tmp_path, expected):
    path = tmp_path / 'trials.jsonl'
    jobs = trials(SETTING, range(4))
    with pytest.raises(KeyboardInterrupt):
        run_jobs(jobs, Dies(after=2), TrialStore(path))
    assert len(path.read_text().splitlines()) == 2
    with path.open('a') as file:
        file.write('{"setting": "cut o')
    told = []
    found = run_jobs(jobs, LocalProcesses(1), TrialStore(path), told.append)
    assert decisions(found) == expected
    assert told == [2, 1, 1]
    assert decisions(run_jobs(jobs, Refuses(), TrialStore(path))) == expected


def test_another_setting_is_not_taken_for_this_one(tmp_path):
    path = tmp_path / 'trials.jsonl'
    run_jobs(trials(SETTING, [0]), LocalProcesses(1), TrialStore(path))
    other = trials(replace(SETTING, segments=11), [0])
    assert other[0].key not in TrialStore(path)


def test_a_file_of_something_else_is_refused(tmp_path):
    path = tmp_path / 'notes.txt'
    path.write_text('hello\nworld\n')
    with pytest.raises(StoreError, match='line 1') as caught:
        TrialStore(path)
    assert isinstance(caught.value, ExperimentError)
    assert isinstance(caught.value, ValueError)
    assert path.read_text() == 'hello\nworld\n'


def test_weights_are_kept_when_they_are_wanted():
    trial = do(Job(SETTING, 0, keep={'weights'}))
    weights = unpack(trial['weights'])
    assert weights.neurons == 225
    assert 'weights' not in do(Job(SETTING, 0))
    values = np.random.default_rng(0).uniform(-1, 1, 9).astype(np.float32)
    random = replace(weights, synapses=np.arange(9) ** 2, values=values)
    assert unpack(pack(random)).same_as(random)


def test_rows_of_a_table_share_their_seeds():
    settings = {'a': SETTING, 'b': SETTING.with_signal('none')}
    assert [(job.setting, job.seed) for job in rows(settings, [3, 4])] == [
        (settings['a'], 3), (settings['b'], 3), (settings['a'], 4), (settings['b'], 4),
    ]  # fmt: skip


def test_nobody_at_the_address_of_a_scheduler_is_an_error_in_words(monkeypatch):
    pytest.importorskip('distributed', reason=NO_DASK)
    monkeypatch.setattr('srnn_experiments.schedulers.DASK_TIMEOUT_S', 0.3)
    with pytest.raises(SchedulerError, match='no Dask scheduler answers'):
        DaskCluster('tcp://127.0.0.1:9')


@pytest.mark.slow
def test_a_dask_cluster_gives_the_same_and_survives_the_loss_of_a_worker(expected):
    distributed = pytest.importorskip('distributed', reason=NO_DASK)
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, processes=True
    ) as cluster:
        longer = trials(replace(SETTING, segments=60), range(8))
        pids = [worker.pid for worker in cluster.workers.values()]
        done = []

        def count(number):
            done.append(number)
            if sum(done) == 2:
                os.kill(pids[0], signal.SIGKILL)

        scheduler = DaskCluster(cluster.scheduler_address)
        began = time.monotonic()
        found = run_jobs(longer, scheduler, TrialStore(), count)
        assert sum(done) == 8
        assert time.monotonic() - began < 120.0
        assert decisions(found[:1]) == decisions([do(longer[0])])
        assert decisions(run_jobs(trials(SETTING, range(4)), scheduler, TrialStore())) == expected
