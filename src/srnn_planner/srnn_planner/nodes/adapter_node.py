# SPDX-License-Identifier: Apache-2.0
"""The adapter: learns from the mismatch of plan and execution, and shares the weights."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
import time

import numpy as np
from std_srvs.srv import Trigger

from srnn_config import Parameters, parameter
from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.ros import belief, dissonance, executed, segment, weights
from srnn_msgs_py.ros import path as path_msg
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.weights import WeightsUpdate
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.run import run
from srnn_planner.core import weights_file
from srnn_planner.core.adapter import Learner, Lesson
from srnn_planner.core.errors import PairingError, SrnnError
from srnn_planner.core.pairing import Pairing
from srnn_planner.core.parameters import ModelParameters
from srnn_planner.core.statistics import Durations
from srnn_planner.core.synaptic_change import input_change


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
        self._learner = Learner(parameters.model, np.random.default_rng([parameters.seed, 1]))
        self._learner.warm_up()
        self._version = 0
        if parameters.initial_weights:
            self._take(weights_file.load(parameters.initial_weights))
        self._initial = self._learner.weights
        self._unsaved = ''
        if parameters.checkpoint and Path(parameters.checkpoint).exists():
            self._restore(weights_file.load(parameters.checkpoint))
        self._pairing = Pairing()
        self._update_times = Durations()
        self._weights = self.advertise('weights')
        self._dissonance = self.advertise('dissonance')
        self._belief = self.advertise('belief')
        self._segment_path = self.advertise('segment_path')
        self._executed_path = self.advertise('executed_path')
        self.listen('segment', segment.from_msg, self._on_segment)
        self.listen('executed', executed.from_msg, self._on_executed)
        for name, action in (('save', self._save), ('load', self._load), ('revert', self._revert)):
            self.create_service(Trigger, f'~/{name}', self._service(action))

    def activate(self) -> None:
        """Share the weights to start from."""
        self._share(0)

    def health(self) -> Health:
        """Report counters and update times."""
        if not self.active:
            return Health()
        level = HealthLevel.WARN if self._unsaved else HealthLevel.OK
        times = {f'update_ms_{k}': v for k, v in self._update_times.summary_ms().items()}
        values = {
            'updates': self._learner.updates,
            'weights_version': self._version,
            **times,
        }
        return Health(level, self._unsaved, values)

    def _on_segment(self, plan: Segment) -> None:
        self._learn(self._pairing.segment(plan))

    def _on_executed(self, path: ExecutedPath) -> None:
        self._learn(self._pairing.executed(path))

    def _learn(self, pair: tuple[Segment, ExecutedPath] | None) -> None:
        if pair is None or not self.active:
            return
        plan, path = pair
        began = time.perf_counter()
        try:
            lesson = self._learner.learn(plan.positions, path.positions)
        except PairingError:
            self.refused_messages += 1
            return
        seconds = time.perf_counter() - began
        if lesson.updated:
            self._version += 1
            self._update_times.record(seconds)
            self._keep(plan.stamp_ns)
            self._share(plan.stamp_ns)
        self._acknowledge(plan.stamp_ns, lesson, seconds)
        self._learner.prepare()
        self._segment_path.publish(path_msg.to_msg(plan))
        self._executed_path.publish(path_msg.to_msg(path))

    def _acknowledge(self, stamp_ns: int, lesson: Lesson, seconds: float) -> None:
        value = Dissonance(
            segment_stamp_ns=stamp_ns,
            signal=self._settings.model.learning.signal,
            updated=lesson.updated,
            weights_version=self._version,
            peak=lesson.peak,
            global_alpha=lesson.squared_distance.astype(np.float32),
            neuron_peak=lesson.rates.max(axis=0).astype(np.float32),
            update_ms=1e3 * seconds,
        )
        self._dissonance.publish(dissonance.to_msg(value))

    def _keep(self, stamp_ns: int) -> None:
        """Write the checkpoint; without room on the disk learning goes on, and says so."""
        if not self._settings.checkpoint:
            return
        update = WeightsUpdate(self._version, stamp_ns, self._learner.weights)
        try:
            weights_file.save(self._settings.checkpoint, update)
            self._unsaved = ''
        except SrnnError as error:
            self._unsaved = str(error)

    def _restore(self, update: WeightsUpdate) -> None:
        self._learner.use_weights(update.matrix)
        self._version = update.version
        self.get_logger().info(f'goes on from version {update.version} of the checkpoint')

    def _share(self, stamp_ns: int) -> None:
        update = WeightsUpdate(self._version, stamp_ns, self._learner.weights)
        self._weights.publish(weights.to_msg(update))
        network = self._settings.model.network
        if network.dimensions == 2:
            change = input_change(self._learner.weights, self._learner.neurons.prior_weights)
            side = network.neurons_per_dimension
            inhibition = np.maximum(-change, 0.0).reshape(side, side)
            now = self.get_clock().now().nanoseconds
            extent = self._settings.model.workspace.half_extent
            self._belief.publish(belief.to_msg(inhibition, extent, now))

    def _take(self, update: WeightsUpdate) -> None:
        self._learner.use_weights(update.matrix)
        self._version = max(self._version + 1, update.version)

    def _save(self) -> str:
        update = WeightsUpdate(self._version, 0, self._learner.weights)
        weights_file.save(self._file(), update)
        return f'saved version {self._version} to {self._file()}'

    def _load(self) -> str:
        self._take(weights_file.load(self._file()))
        self._keep(0)
        self._share(0)
        return f'loaded {self._file()} as version {self._version}'

    def _revert(self) -> str:
        self._take(WeightsUpdate(self._version, 0, self._initial))
        self._keep(0)
        self._share(0)
        return f'back to the initial weights as version {self._version}'

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
