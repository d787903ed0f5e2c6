# SPDX-License-Identifier: Apache-2.0
"""The adapter: learns from the mismatch of plan and execution, and shares the weights."""

from collections.abc import Callable, Sequence
import time
from typing import TypeVar

from srnn_msgs_py.health import Health
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.ros import dissonance, executed, refusal, segment, weights
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_node import trigger
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.run import run
from srnn_planner.core import weights_file
from srnn_planner.core.adapter_health import adapter_health
from srnn_planner.core.checkpoint_keeper import CheckpointKeeper
from srnn_planner.core.errors import PairingError, SrnnError
from srnn_planner.core.learning_session import Learned, LearningSession
from srnn_planner.core.statistics import Durations
from srnn_planner.core.weights_requests import WeightsRequests
from srnn_planner.nodes.adapter_parameters import AdapterParameters
from srnn_planner.nodes.learning_display import LearningDisplay

V = TypeVar('V')


class AdapterNode(WorkspaceNode):
    """Learns while active; inactive it keeps its weights and publishes nothing."""

    PARAMETERS = AdapterParameters
    ACTIVE_PRIORITY = 10

    def __init__(self) -> None:
        """Create the node, unconfigured."""
        super().__init__('adapter')

    def configure(self, parameters: AdapterParameters) -> None:
        """Load weights, compile the kernels, connect topics and services."""
        file = parameters.initial_weights
        initial = weights_file.load(file) if file else None
        self.keep_journal('adapter/journal')
        self._session = LearningSession(
            parameters.model, parameters.seed, initial, self._journal.note
        )
        self._model = self._session.model
        self._session.learner.warm_up()
        self._keeper = CheckpointKeeper(parameters.checkpoint)
        self._restore()
        if self._keeper.version is not None:
            self._journal.note(Deed.RESTORED, self._keeper.version)
        self._update_times = Durations()
        self._weights = self.advertise('weights')
        self._dissonance = self.advertise('dissonance')
        self._display = LearningDisplay(self, parameters.model)
        self.listen('segment', segment.from_msg, self._on_segment)
        self.listen('executed', executed.from_msg, self._on_executed)
        self.listen('weights_refused', refusal.from_msg, self._on_refused)
        requests = WeightsRequests(
            self._model, parameters.weights_file, self._now, self._on_request
        )
        trigger.offer(self, 'save', requests.save, SrnnError)
        trigger.offer(self, 'load', requests.load, SrnnError)
        trigger.offer(self, 'revert', requests.revert, SrnnError)

    def activate(self) -> None:
        """Share the weights to start from."""
        self._session.begin()
        self._share(0)

    def deactivate(self) -> None:
        """Learn no more."""
        self._session.end()

    def health(self) -> Health:
        """Report counters, update times and what is wrong with keeping what was learned."""
        if not self.active:
            return Health()
        return adapter_health(self._session, self._keeper, self._update_times)

    def _on_segment(self, plan: Segment) -> None:
        self._learn(self._session.segment, plan)

    def _on_executed(self, path: ExecutedPath) -> None:
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
        if learned.lesson.updated:
            self._update_times.record(seconds)
            self._keep_and_share(learned.plan.stamp_ns)
        told = self._session.acknowledgement(learned, 1e3 * seconds)
        self._dissonance.publish(dissonance.to_msg(told))
        self._display.pair(learned)

    def _on_refused(self, refused: WeightsRefusal) -> None:
        went_back = self._session.refused(refused, self._now())
        if went_back is None:
            return
        if went_back.left is not None:
            self._keeper.keep_refused(went_back.left)
        self.get_logger().error(went_back.words)
        self._keep_and_share(0)
        self.report_health()

    def _on_request(self, deed: Deed, first: int) -> None:
        self._journal.note(deed, first)
        self._keep_and_share(0)

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
        self._weights.publish(weights.to_msg(self._session.shared(stamp_ns)))
        self._display.weights(self._session.learner.synapses, self._now())

    def _now(self) -> int:
        return int(self.get_clock().now().nanoseconds)


def main(args: Sequence[str] | None = None) -> int:
    """Run the adapter as a process."""
    return run(AdapterNode, args)


if __name__ == '__main__':
    raise SystemExit(main())
