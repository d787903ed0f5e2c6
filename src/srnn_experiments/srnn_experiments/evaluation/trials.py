# SPDX-License-Identifier: Apache-2.0
"""The trials that the figures of an evaluation are made of."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from srnn_experiments.campaign import Job
from srnn_experiments.setting import Setting

SIGNALS = ('none', 'global', 'local')
LEARNING = ('global', 'local')
RATES = (0.001, 0.01, 0.1)
TRIGGERED, UNTRIGGERED = 'constant', 'untriggered'
"""Constant rates where the global signal triggers, and everywhere."""

Trial = Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class Evaluation:
    """The finished trials.

    Attributes:
        base: scene, network, world, and length of the trials of `SIGNALS`.
        seeds: of the trials of every setting, in order.
        long: length of the trials with a constant rate [segments].
        trials: by name of their setting, in the order of the seeds.

    """

    base: Setting
    seeds: Sequence[int]
    long: int
    trials: Mapping[str, Sequence[Trial]]

    def known(self, name: str) -> dict[str, Any]:
        """Return what every figure says of its trials."""
        return {
            'scene': self.base.scene.task.name,
            'world': self.base.world,
            'arm_model': self.base.arm_model,
            'segments': self.long if name in constant_rates() else self.base.segments,
            'seeds': list(self.seeds),
        }


def constant_rates() -> dict[str, tuple[str, float]]:
    """Return signal and rate of every setting with a constant rate, by name."""
    return {f'{s} {rate:g}': (s, rate) for s in (TRIGGERED, UNTRIGGERED) for rate in RATES}


def jobs(base: Setting, seeds: Sequence[int], long: int) -> dict[str, list[Job]]:
    """Return the trials to do for every setting, by name.

    Every trial leaves its trace and the change of its network, the first one of a learning
    signal its paths as well.
    """
    every, first = frozenset({'trace', 'change'}), frozenset({'trace', 'change', 'paths'})
    settings = {name: base.with_signal(name) for name in SIGNALS}
    for name, (signal, rate) in constant_rates().items():
        settings[name] = replace(base.with_signal(signal, rate), segments=long)
    return {
        name: [
            Job(setting, seed, first if name in LEARNING and seed == seeds[0] else every)
            for seed in seeds
        ]
        for name, setting in settings.items()
    }


def evaluation(
    base: Setting,
    seeds: Sequence[int],
    long: int,
    result: Callable[[Job], Trial],
) -> Evaluation:
    """Return the evaluation of trials that are all done; `result` returns that of a job."""
    done = {name: [result(job) for job in todo] for name, todo in jobs(base, seeds, long).items()}
    return Evaluation(base, seeds, long, done)
