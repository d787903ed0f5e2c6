# SPDX-License-Identifier: Apache-2.0
"""The JSON of `srnn experiment run` and `srnn demo`: a setting, its trials, their summary."""

from collections.abc import Mapping, Sequence
from typing import Any

from srnn_experiments.figures import summary
from srnn_planner.core.parameters import LearningParameters

_CONSTANT_SIGNALS = ('constant', 'untriggered')


def experiment_document(
    scene: str,
    learning: LearningParameters,
    segments: int,
    seed: int,
    world: str,
    arm_model: str | None,
    trials: Sequence[Mapping[str, Any]],
) -> dict[str, Any]:
    """Return the report as plain data.

    `arm_model` is the model of the arm, None in the world of a point. Figures that were never
    heard of are None; a standard deviation over one trial is 0.
    """
    return {
        'scene': scene,
        'signal': learning.signal,
        'alpha': learning.rate if learning.signal in _CONSTANT_SIGNALS else None,
        'segments': segments,
        'seed': seed,
        'world': world,
        'arm_model': arm_model,
        'trials': list(trials),
        'summary': summary(trials),
    }
