# SPDX-License-Identifier: Apache-2.0
"""What it costs to have every update on the disk before it is shared.

Run: .venv/bin/python bench/checkpoint.py [DIRECTORY]
"""

from pathlib import Path
import sys
import tempfile
import time

import numpy as np

from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core import weights_file
from srnn_planner.core.adapter import Learner
from srnn_planner.core.checkpoint_keeper import CheckpointKeeper
from srnn_planner.core.history import LENGTH
from srnn_planner.core.learned_model import LearnedModel
from srnn_planner.core.parameters import ModelParameters
from srnn_planner.core.synapses import Synapses

SAVES = 200


def full_model() -> LearnedModel:
    """Return a model whose history and way back are as long as they get."""
    model = LearnedModel(Learner(ModelParameters(), np.random.default_rng(1)))
    rng = np.random.default_rng(2)
    prior = model.learner.neurons.prior
    for n in range(LENGTH):
        weights = rng.uniform(-1.0, 1.0, (prior.grid.count,) * 2).astype(np.float32)
        model.load(WeightsUpdate(n, 0, Synapses.of(prior, weights).learned), n)
    return model


def main(directory: Path) -> None:
    """Print the time of a save, and of the weights alone for comparison."""
    model, keeper = full_model(), CheckpointKeeper(str(directory / 'checkpoint.npz'))
    spent: dict[str, list[float]] = {'weights alone': [], 'checkpoint': []}
    for _ in range(SAVES):
        began = time.perf_counter()
        weights_file.save(directory / 'weights.npz', model.weights)
        between = time.perf_counter()
        keeper.keep(model.checkpoint())
        spent['weights alone'].append(between - began)
        spent['checkpoint'].append(time.perf_counter() - between)
    assert not keeper.unsaved, keeper.unsaved
    for what, seconds in spent.items():
        size = (directory / f'{what.split()[0]}.npz').stat().st_size / 1e6
        p50, p99 = 1e3 * np.percentile(seconds, [50.0, 99.0])
        print(f'{what}: {size:.2f} MB, {p50:.1f} ms (median), {p99:.1f} ms (99 %)')


if __name__ == '__main__':
    with tempfile.TemporaryDirectory(dir=sys.argv[1] if len(sys.argv) > 1 else None) as folder:
        main(Path(folder))
