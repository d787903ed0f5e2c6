# SPDX-License-Identifier: Apache-2.0
"""The planner: samples the next segment in time for the tracker to go on without a stop."""

from collections.abc import Callable, Sequence
from functools import partial
import time
from typing import TypeVar

from srnn_config.scene import load_scene
from srnn_msgs_py.health import Health
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.result import SegmentResult
from srnn_msgs_py.ros import dissonance, executed, pose, result, segment, waypoints, weights
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.tip import TipPosition
from srnn_msgs_py.waypoints import Waypoints
from srnn_msgs_py.weights import WeightsUpdate
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.run import run
from srnn_planner.core.doubts import Doubts
from srnn_planner.core.errors import SrnnError
from srnn_planner.core.planner_health import planner_health
from srnn_planner.core.planning_session import Origin, PlanningSession
from srnn_planner.core.statistics import Durations
from srnn_planner.nodes.planner_parameters import PlannerParameters
from srnn_planner.nodes.planning_display import PlanningDisplay
from srnn_planner.nodes.weights_trouble import WeightsTrouble

V = TypeVar('V')


class PlannerNode(WorkspaceNode):
    """Plans segments while active; inactive it publishes none, and the arm comes to rest."""

    PARAMETERS = PlannerParameters
    ACTIVE_PRIORITY = 20

    def __init__(self) -> None:
        """Create the node, unconfigured."""
        super().__init__('planner')
        self._last_stamp = 0

    def configure(self, parameters: PlannerParameters) -> None:
        """Load the scene, connect the topics, compile the kernels."""
        scene = load_scene(parameters.scene)
        origin = Origin(scene, parameters.model, parameters.planning, parameters.seed)
        self.keep_journal('planner/journal')
        self._session = PlanningSession(origin, self._journal.note)
        self._planning_times = Durations()
        self._doubts = Doubts()
        self._segment = self.advertise('segment')
        self._trouble = WeightsTrouble(self, self._session.watched)
        self._display = PlanningDisplay(self, self._session, scene.task.reach_radius)
        self.listen('current_pose', pose.from_msg, self._on_pose)
        self.listen('executed', executed.from_msg, self._on_executed)
        self.listen('segment_result', result.from_msg, self._on_result)
        self.listen('dissonance', dissonance.from_msg, self._session.lesson)
        self.listen('waypoints', waypoints.from_msg, self._on_waypoints)
        # After the topics, because meanwhile the middleware finds the other nodes.
        self._session.planner.warm_up()
        # Weights are signed anew for whoever asks, and must be read while they are fresh.
        neurons = parameters.model.network.neurons
        self.listen('weights', partial(weights.from_msg, neurons=neurons), self._on_weights)

    def activate(self) -> None:
        """Begin with the arm as it is seen next."""
        self._session.begin()
        self._show_waypoints()

    def seconds_to_tick(self) -> float | None:
        """Return the time until the next plan is due [s]."""
        wake = self._session.sequencer.wake_time()
        return None if wake is None else wake - time.monotonic()

    def on_tick(self) -> None:
        """Plan and publish the segment that is due."""
        began = time.monotonic()
        if self._doubts.blind(began):
            self._session.blind()
            return
        trajectory = self._session.plan(began, time.monotonic)
        if trajectory is None:
            self._trouble.tell()
            return
        planned = time.monotonic()
        self._last_stamp = max(self.get_clock().now().nanoseconds, self._last_stamp + 1)
        knots = Segment(self._last_stamp, **vars(trajectory))
        self._segment.publish(segment.to_msg(knots))
        self._planning_times.record(planned - began)
        self._session.sent(self._last_stamp, trajectory, began, time.monotonic())
        self._trouble.tell()
        self.report_health()
        self._display.imagination(self._last_stamp)

    def health(self) -> Health:
        """Report counters and planning times."""
        if not self.active:
            return Health()
        doubts = self._doubts.words(time.monotonic())
        return planner_health(self._session, self._planning_times, self._last_stamp, doubts)

    def _on_pose(self, tip: TipPosition) -> None:
        self._doubts.posed(time.monotonic())
        if self.active:  # Nothing comes of earlier ones.
            self._journal.note(Deed.POSED, tip.stamp_ns)
        self._session.pose(tip.position)

    def _on_executed(self, path: ExecutedPath) -> None:
        if self._accepts(self._session.executed, path):
            self._show_waypoints()

    def _on_result(self, ended: SegmentResult) -> None:
        self._doubts.ended(ended.code)
        self._session.result(ended, time.monotonic())

    def _on_weights(self, update: WeightsUpdate) -> None:
        self._accepts(self._session.weights, update)
        self._trouble.tell()

    def _on_waypoints(self, tour: Waypoints) -> None:
        self._accepts(self._session.tour, tour)
        self._show_waypoints()

    def _accepts(self, take: Callable[[V], bool | None], value: V) -> bool | None:
        """Have the session take in a value; count and log one that it refuses."""
        try:
            return take(value)
        except SrnnError as error:
            self.refused_messages += 1
            self.get_logger().warning(str(error))
            return False

    def _show_waypoints(self) -> None:
        self._display.waypoints(self.get_clock().now().nanoseconds)


def main(args: Sequence[str] | None = None) -> int:
    """Run the planner as a process."""
    return run(PlannerNode, args)


if __name__ == '__main__':
    raise SystemExit(main())
