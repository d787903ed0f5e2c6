# SPDX-License-Identifier: Apache-2.0
"""What an adapter says of itself."""

from srnn_msgs_py.health import Health, HealthLevel
from srnn_planner.core.checkpoint_keeper import CheckpointKeeper
from srnn_planner.core.learning_session import LearningSession
from srnn_planner.core.statistics import Durations


def adapter_health(
    session: LearningSession, keeper: CheckpointKeeper, update_times: Durations
) -> Health:
    """Return counters, update times and what is wrong with keeping what was learned."""
    model = session.model
    wrong = '; '.join(filter(None, [keeper.unsaved, keeper.broken, session.went_back]))
    times = {f'update_ms_{k}': v for k, v in update_times.summary_ms().items()}
    values = {
        'updates': session.learner.updates,
        'weights_version': model.weights.version,
        'checkpoint_version': 'none' if keeper.version is None else keeper.version,
        'checkpoint_error': keeper.unsaved or keeper.broken,
        'reverts': model.reverts,
        **times,
    }
    return Health(HealthLevel.WARN if wrong else HealthLevel.OK, wrong, values)
