# SPDX-License-Identifier: Apache-2.0
"""An update that was acknowledged outlives the adapter, at whatever instant it is killed."""

import os
from pathlib import Path
import select
import signal
import time

import numpy as np
import pytest

from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate
from srnn_planner.core.adapter import Learner
from srnn_planner.core.checkpoint_keeper import CheckpointKeeper
from srnn_planner.core.learned_model import LearnedModel
from srnn_planner.core.lineage import KEPT
from srnn_planner.core.parameters import ModelParameters, NetworkParameters
from srnn_planner.core.prior import PriorWeights

MODEL = ModelParameters(network=NetworkParameters(neurons_per_dimension=12))
COUNT = MODEL.network.neurons
PRIOR = PriorWeights(MODEL.network).checksum
KILLS_PER_REPEAT = 10
PATIENCE_S = 30.0
LONGEST_LIFE_S = 0.05


def content(version: int) -> LearnedWeights:
    values = np.full(COUNT**2, (version % 1000) / 1000.0, np.float32)
    return LearnedWeights(COUNT, PRIOR, np.arange(COUNT**2), values)


def restored(place: Path) -> tuple[LearnedModel, CheckpointKeeper]:
    model = LearnedModel(Learner(MODEL, np.random.default_rng(1)))
    keeper = CheckpointKeeper(str(place))
    keeper.restore(lambda value: model.restore(value, 0))
    return model, keeper


def save_until_killed(place: Path, acknowledgements: int) -> None:
    """What an adapter does with every update: keep it, then tell of it."""
    model, keeper = restored(place)
    while True:
        version = model.weights.version + 1
        model.load(WeightsUpdate(version, version, content(version)), version)
        keeper.keep(model.checkpoint())
        assert not keeper.unsaved
        os.write(acknowledgements, version.to_bytes(8, 'little'))


class Child:
    """A process that saves and acknowledges, until it is killed."""

    def __init__(self, place: Path) -> None:
        self._read, write = os.pipe()
        self.pid = os.fork()
        if not self.pid:
            try:
                save_until_killed(place, write)
            finally:
                os._exit(1)
        os.close(write)

    def kill(self, after_s: float) -> int:
        """Kill it some time after its first acknowledgement; return the last one."""
        assert select.select([self._read], [], [], PATIENCE_S)[0], 'nothing was saved'
        time.sleep(after_s)
        os.kill(self.pid, signal.SIGKILL)
        _, status = os.waitpid(self.pid, 0)
        with os.fdopen(self._read, 'rb') as file:
            told = file.read()
        assert os.WIFSIGNALED(status), 'it ended by itself'
        assert told, 'it ended by itself'
        return int.from_bytes(told[-8:], 'little')


@pytest.mark.filterwarnings('ignore:This process:DeprecationWarning')
def test_no_acknowledged_update_is_lost_by_a_kill(ledger, rng, tmp_path):
    """Row 3 of the fault matrix: the new adapter goes on from the last update."""
    place, versions = tmp_path / 'checkpoint.npz', [0]
    for _ in range(KILLS_PER_REPEAT * ledger.repeats):
        with ledger.injection(3, 'adapter killed while it saves'):
            last = Child(place).kill(rng.uniform(0.0, LONGEST_LIFE_S))
            model, keeper = restored(place)
            assert not keeper.broken
            assert keeper.version == model.weights.version
            # What was saved but not yet told may be there too, no more.
            assert versions[-1] < last <= model.weights.version <= last + 1
            version = model.weights.version
            assert model.weights.learned.same_as(content(version))
            earlier = model.checkpoint().earlier
            assert [w.version for w in earlier] == list(range(max(0, version - KEPT), version))
            for weights in earlier[1:]:
                assert weights.learned.same_as(content(weights.version))
            left = {name.name for name in tmp_path.iterdir()}
            assert left <= {'checkpoint.npz', 'checkpoint.npz.previous'}
            versions.append(version)
