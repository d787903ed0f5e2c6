# SPDX-License-Identifier: Apache-2.0
"""The adapter: learns from the mismatch of plan and execution, and shares the weights."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
import time
from typing import TypeVar

import numpy as np
from std_srvs.srv import Trigger

from srnn_config import Parameters, parameter
from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.ros import (
    belief,
    belief_markers,
    dissonance,
    executed,
    refusal,
    segment,
    weights,
)
from srnn_msgs_py.ros import path as path_msg
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.weights import WeightsUpdate
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.run import run
from srnn_planner.core import weights_file
from srnn_planner.core.adapter import Lesson
from srnn_planner.core.checkpoint_keeper import CheckpointKeeper
from srnn_planner.core.errors import PairingError, SrnnError
from srnn_planner.core.learning_session import Learned, LearningSession
from srnn_planner.core.parameters import ModelParameters
from srnn_planner.core.statistics import Durations
from srnn_planner.core.synapses import Synapses
from srnn_planner.core.synaptic_change import input_change

V = TypeVar('V')


@dataclass(frozen=True)
class AdapterParameters(Parameters):
    """Parameters of the adapter node."""

    seed: int = parameter(0, minimum=0, doc='Seed of all random numbers of the adapter.')
    initial_weights: str = parameter('', doc='Weight file to start from; empty for the prior.')
    weights_file: str = parameter('', doc='File of the services ~/save and ~/load.')
    checkpoint: str = parameter(
        '', doc='File that keeps every update before it is shared, and that a restarted adapter '
        'goes on from; empty for none.',
    )
    model: ModelParameters = field(default_factory=ModelParameters)


class AdapterNode(WorkspaceNode):
    """Learns while active; inactive it keeps its weights and publishes nothing."""

    PARAMETERS = AdapterParameters
    ACTIVE_PRIORITY = 10

    def __init__(self) -> None:
        """Create the node, unconfigured."""
        super().__init__('adapter')

    def configure(self, parameters: AdapterParameters) -> None:
        """Load weights, compile the kernels, connect topics and services."""
        self._settings = parameters
        file = parameters.initial_weights
        initial = weights_file.load(file) if file else None
        self._session = LearningSession(parameters.model, parameters.seed, initial)
        self._learner, self._model = self._session.learner, self._session.model
        self._learner.warm_up()
        self._went_back = ''
        self._keeper = CheckpointKeeper(parameters.checkpoint)
        self._restore()
        self.keep_journal('adapter/journal')
        if self._keeper.version is not None:
            self._journal.note(Deed.RESTORED, self._keeper.version)
        self._update_times = Durations()
        self._weights = self.advertise('weights')
        self._dissonance = self.advertise('dissonance')
        self._belief = self.advertise('belief')
        self._columns = self.advertise('belief_markers')
        self._segment_path = self.advertise('segment_path')
        self._executed_path = self.advertise('executed_path')
        self.listen('segment', segment.from_msg, self._on_segment)
        self.listen('executed', executed.from_msg, self._on_executed)
        self.listen('weights_refused', refusal.from_msg, self._on_refused)
        for name, action in (('save', self._save), ('load', self._load), ('revert', self._revert)):
            self.create_service(Trigger, f'~/{name}', self._service(action))

    def activate(self) -> None:
        """Share the weights to start from."""
        self._journal.note(Deed.ACTIVATED)
        self._session.active = True
        self._share(0)

    def deactivate(self) -> None:
        """Learn no more."""
        self._journal.note(Deed.DEACTIVATED)
        self._session.active = False

    def health(self) -> Health:
        """Report counters, update times and what is wrong with keeping what was learned."""
        if not self.active:
            return Health()
        keeper = self._keeper
        wrong = '; '.join(filter(None, [keeper.unsaved, keeper.broken, self._went_back]))
        times = {f'update_ms_{k}': v for k, v in self._update_times.summary_ms().items()}
        values = {
            'updates': self._learner.updates,
            'weights_version': self._model.weights.version,
            'checkpoint_version': 'none' if keeper.version is None else keeper.version,
            'checkpoint_error': keeper.unsaved or keeper.broken,
            'reverts': self._model.reverts,
            **times,
        }
        return Health(HealthLevel.WARN if wrong else HealthLevel.OK, wrong, values)

    def _on_segment(self, plan: Segment) -> None:
        self._journal.note(Deed.PLAN, plan.stamp_ns)
        self._learn(self._session.segment, plan)

    def _on_executed(self, path: ExecutedPath) -> None:
        self._journal.note(Deed.EXECUTED, path.stamp_ns)
        self._learn(self._session.executed, path)

    def _learn(self, take: Callable[[V, int], Learned | None], value: V) -> None:
        began = time.perf_counter()
        try:
            learned = take(value, self._now())
        except PairingError:
            self.refused_messages += 1
            return
        if learned is None:
            return
        seconds = time.perf_counter() - began
        plan, lesson = learned.plan, learned.lesson
        if lesson.updated:
            self._went_back = ''
            self._update_times.record(seconds)
            self._keep_and_share(plan.stamp_ns)
        self._acknowledge(plan.stamp_ns, lesson, seconds)
        self._segment_path.publish(path_msg.to_msg(plan))
        self._executed_path.publish(path_msg.to_msg(learned.path))

    def _on_refused(self, refused: WeightsRefusal) -> None:
        """Go back to earlier weights, so that learning goes on from there too."""
        self._journal.note(Deed.REFUSED, refused.refused_version, refused.good_version)
        left = self._model.leave(refused, self._now())
        if left is not None:
            self._keeper.keep_refused(left)
            done = f'left weights version {left.version} for earlier ones'
        elif self._model.catch_up(refused, self._now()):
            done = 'went on with the same weights'
        else:
            return
        self._went_back = f'{done}, now version {self._model.weights.version}: {refused.reason}'
        self.get_logger().error(self._went_back)
        self._keep_and_share(0)
        self.report_health()

    def _acknowledge(self, stamp_ns: int, lesson: Lesson, seconds: float) -> None:
        value = Dissonance(
            segment_stamp_ns=stamp_ns,
            signal=self._settings.model.learning.signal,
            updated=lesson.updated,
            weights_version=self._model.weights.version,
            peak=lesson.peak,
            global_alpha=lesson.squared_distance.astype(np.float32),
            neuron_peak=lesson.neuron_peak.astype(np.float32),
            update_ms=1e3 * seconds,
        )
        self._dissonance.publish(dissonance.to_msg(value))

    def _restore(self) -> None:
        if self._keeper.restore(lambda value: self._model.restore(value, self._now())):
            version = self._model.weights.version
            self.get_logger().info(f'goes on from version {version} of the checkpoint')
        if self._keeper.broken:
            self.get_logger().error(f'broken checkpoint: {self._keeper.broken}')

    def _keep_and_share(self, stamp_ns: int) -> None:
        """Let nobody have weights that a crash could take back.

        Without room on the disk learning goes on, and the health says so.
        """
        self._keeper.keep(self._model.checkpoint())
        self._share(stamp_ns)

    def _share(self, stamp_ns: int) -> None:
        synapses = self._learner.synapses
        update = WeightsUpdate(self._model.weights.version, stamp_ns, synapses.learned)
        self._weights.publish(weights.to_msg(update))
        network = self._settings.model.network
        if network.dimensions == 2:
            change = input_change(synapses, Synapses(synapses.prior))
            side = network.neurons_per_dimension
            inhibition = np.maximum(-change, 0.0).reshape(side, side)
            extent = self._settings.model.workspace.half_extent
            self._belief.publish(belief.to_msg(inhibition, extent, self._now()))
            self._columns.publish(belief_markers.to_msg(inhibition, extent, self._now()))

    def _now(self) -> int:
        return int(self.get_clock().now().nanoseconds)

    def _save(self) -> str:
        value = self._model.weights
        weights_file.save(self._file(), value)
        return f'saved version {value.version} to {self._file()}'

    def _load(self) -> str:
        self._model.load(weights_file.load(self._file()), self._now())
        self._journal.note(Deed.LOAD, self._model.weights.version)
        self._keep_and_share(0)
        return f'loaded {self._file()} as version {self._model.weights.version}'

    def _revert(self) -> str:
        self._journal.note(Deed.REVERT)
        self._model.revert(self._now())
        self._keep_and_share(0)
        return f'back to the initial weights as version {self._model.weights.version}'

    def _file(self) -> str:
        if not self._settings.weights_file:
            raise SrnnError('parameter weights_file is empty: name a file to use this service')
        return self._settings.weights_file

    @staticmethod
    def _service(action: Callable[[], str]) -> Callable[..., Trigger.Response]:
        def answer(_: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
            try:
                response.message, response.success = action(), True
            except SrnnError as error:
                response.message, response.success = str(error), False
            return response

        return answer


def main(args: Sequence[str] | None = None) -> int:
    """Run the adapter as a process."""
    return run(AdapterNode, args)


if __name__ == '__main__':
    raise SystemExit(main())
