# SPDX-License-Identifier: Apache-2.0
"""Whoever runs the network draws its spikes from the distribution of the reference.

Of 20 runs each, five figures are compared: spikes in all steps, in the first tau and in the
last ten, and where the spikes lie along x and y. Each may differ by six standard errors of
the difference. By Welch's test, with the 19 degrees of freedom that it has at least, a true
match differs more in 9 of a million comparisons: a test here fails in vain once in 20 000 times.
"""

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from srnn_bench.compiled_network import CompiledSampler, WholePlanning
from srnn_bench.network_contenders import NETWORK_CONTENDERS, NetworkSetting
from srnn_bench.network_task import NetworkRun
from srnn_bench.numpy_network import NumpyNetwork
from srnn_bench.one_after_another import OneAfterAnother
from srnn_bench.remote import Remote
from srnn_planner.core import sampling
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

RUNS, BOUND = 20, 6.0
SETTING = NetworkSetting(ModelParameters(), PlanningParameters(), 0)
TASK = SETTING.task


@pytest.fixture(scope='module', autouse=True)
def one_thread():
    """Threads of BLAS that wait for each other take a busy machine a hundred times as long."""
    with threadpool_limits(1):
        yield


def figures(runner, first_seed):
    """Return the five figures of every run (RUNS, 5)."""
    rows = []
    for seed in range(first_seed, first_seed + RUNS):
        run = runner.run(seed)
        assert run.seconds > 0.0
        assert run.spikes.shape == (TASK.steps, len(TASK.positions))
        total = run.spikes.sum()
        place = run.spikes.sum(axis=0) @ TASK.positions / total
        rows.append(
            [total, run.spikes[: TASK.network.tau].sum(), run.spikes[-10:].sum(), *place]
        )  # fmt: skip
    return np.array(rows)


def deviation(a, b):
    """Return how many standard errors the means of figures are apart (5,)."""
    error = np.sqrt((a.var(axis=0, ddof=1) + b.var(axis=0, ddof=1)) / RUNS)
    return np.abs(a.mean(axis=0) - b.mean(axis=0)) / error


@pytest.fixture(scope='module')
def reference():
    return figures(NumpyNetwork(TASK), 1000)


@pytest.fixture
def start():
    """Start a contender by name, in a process of its own, unless it is not installed."""
    running = []

    def begin(name):
        (contender,) = (c for c in NETWORK_CONTENDERS if c.name == name)
        if contender.absence():
            pytest.skip(f'{name}: {contender.absence()}')
        running.append(
            Remote(
                f'srnn_bench.{contender.module}', contender.kind, contender.arguments(SETTING),
                contender.peer.apart,
            )
        )  # fmt: skip
        return running[0]

    yield begin
    for remote in running:
        remote.close()


def spikes_without_limit(network, u, since):
    """Return the spike probability of `pp_psc_delta` in place of `sampling.activation`."""
    rate = np.exp(network.slope * u - network.threshold)
    return np.where(since <= network.tau, 0.0, -np.expm1(-rate))


def test_the_compiled_sampler_draws_from_the_distribution_of_the_reference(reference):
    found = figures(CompiledSampler(TASK, SETTING.planning), 0)
    assert (deviation(found, reference) < BOUND).all()


def test_one_sample_after_another_draws_from_the_same_distribution(reference):
    found = figures(OneAfterAnother(NumpyNetwork(TASK.one_sample()), TASK.samples), 0)
    assert (deviation(found, reference) < BOUND).all()


def test_one_sample_after_another_has_other_random_numbers_for_each_sample_and_seed():
    asked = []

    class Recorder:
        def run(self, seed):
            asked.append(seed)
            return NetworkRun(0.25, np.eye(2, dtype=np.int64))

    runs = [OneAfterAnother(Recorder(), 40).run(seed) for seed in range(50)]
    assert len(set(asked)) == len(asked) == 40 * 50
    assert 0 <= min(asked) <= max(asked) < 2**31
    for run in runs:
        assert run.seconds == 10.0
        assert (run.spikes == 40 * np.eye(2)).all()


def test_whole_planning_runs_the_same_network(reference):
    """Its way point has context neurons of its own, which pull to another place."""
    found = figures(WholePlanning(SETTING.model, SETTING.planning, 0), 0)
    assert (deviation(found, reference)[1] < BOUND).all()
    assert abs(found[:, 0].mean() / reference[:, 0].mean() - 1.0) < 0.02


@pytest.mark.parametrize(
    'name',
    [
        'brian2-numpy',
        pytest.param('brian2-cython', marks=pytest.mark.slow),
        pytest.param('brian2-cpp', marks=pytest.mark.slow),
        pytest.param('brian2-numpy-one', marks=pytest.mark.slow),
        pytest.param('brian2-cython-one', marks=pytest.mark.slow),
        pytest.param('brian2-cpp-one', marks=pytest.mark.slow),
    ],
)
def test_brian2_draws_from_the_distribution_of_the_reference(name, start, reference):
    assert (deviation(figures(start(name), 0), reference) < BOUND).all()


@pytest.mark.slow
@pytest.mark.parametrize('name', ['nest', 'nest-one'])
def test_nest_draws_from_its_law_of_spiking_and_in_all_else_from_the_reference(
    name, start, reference, monkeypatch
):
    nest = figures(start(name), 0)
    monkeypatch.setattr(sampling, 'activation', spikes_without_limit)
    assert (deviation(nest, figures(NumpyNetwork(TASK), 1000)) < BOUND).all()
    # That law is another one, as the table says: the comparison tells them apart.
    assert deviation(nest, reference)[0] > BOUND
