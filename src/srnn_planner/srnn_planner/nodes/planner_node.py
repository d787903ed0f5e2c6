# SPDX-License-Identifier: Apache-2.0
"""The planner: samples the next segment in time for the tracker to go on without a stop."""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from functools import partial
import time
from typing import TypeVar

from srnn_config import Parameters, parameter
from srnn_config.scene import load_scene
from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import (
    dissonance,
    executed,
    markers,
    pose,
    refusal,
    result,
    samples,
    segment,
    spikes,
    waypoints,
    weights,
)
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.tip import TipPosition
from srnn_msgs_py.waypoints import Waypoints
from srnn_msgs_py.weights import WeightsUpdate
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.run import run
from srnn_planner.core.errors import SrnnError
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planning_session import Origin, PlanningSession
from srnn_planner.core.statistics import Durations

BLIND_S = 1.0
"""Without a pose for this long it is not known where the arm is [s]."""

V = TypeVar('V')

STALE_IN_A_ROW = 3
"""An interruption of the link makes a segment or two too old, a wrong clock makes all."""


@dataclass(frozen=True)
class PlannerParameters(Parameters):
    """Parameters of the planner node."""

    scene: str = parameter(doc='Scene file with way points, reach radius and velocity.')
    seed: int = parameter(0, minimum=0, doc='Seed of all random numbers of the planner.')
    model: ModelParameters = field(default_factory=ModelParameters)
    planning: PlanningParameters = field(default_factory=PlanningParameters)


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
        self._workspace = parameters.model.workspace
        self._reach_radius = scene.task.reach_radius
        self._session = PlanningSession(
            Origin(scene, parameters.model, parameters.planning, parameters.seed)
        )
        self.keep_journal('planner/journal')
        self._sequencer = self._session.sequencer
        self._watched, self._told = self._session.watched, ''
        self._planning_times = Durations()
        self._pose_time = 0.0
        self._stale_in_a_row = 0
        self._segment = self.advertise('segment')
        self._refused = self.advertise('weights_refused')
        self._markers = self.advertise('markers')
        self._samples = self.advertise('samples')
        self._spikes = self.advertise('spikes')
        self.listen('current_pose', pose.from_msg, self._on_pose)
        self.listen('executed', executed.from_msg, self._on_executed)
        self.listen('segment_result', result.from_msg, self._on_result)
        self.listen('dissonance', dissonance.from_msg, self._on_dissonance)
        self.listen('waypoints', waypoints.from_msg, self._on_waypoints)
        # After the topics, because meanwhile the middleware finds the other nodes.
        self._session.planner.warm_up()
        # Weights are signed anew for whoever asks, and must be read while they are fresh.
        neurons = parameters.model.network.neurons
        self.listen('weights', partial(weights.from_msg, neurons=neurons), self._on_weights)

    def activate(self) -> None:
        """Begin with the arm as it is seen next."""
        self._journal.note(Deed.ACTIVATED)
        self._sequencer.forget_motion()
        self._show_waypoints()

    def seconds_to_tick(self) -> float | None:
        """Return the time until the next plan is due [s]."""
        wake = self._sequencer.wake_time()
        return None if wake is None else wake - time.monotonic()

    def on_tick(self) -> None:
        """Plan and publish the segment that is due."""
        began = time.monotonic()
        if began - self._pose_time > BLIND_S:
            # A segment from where the arm was would be refused, and the next one be late.
            self._journal.note(Deed.BLIND)
            self._sequencer.forget_motion()
            return
        request = self._sequencer.request(began)
        if request is None:
            self._journal.note(Deed.PLANNED, time_s=began)
            return
        trajectory = self._watched.plan(request)
        planned = time.monotonic()
        if trajectory is None:
            self._journal.note(Deed.PLANNED_IN_VAIN, time_s=began, until_s=planned)
            self._sequencer.failed(planned - began, planned)
            self._tell()
            return
        self._last_stamp = max(self.get_clock().now().nanoseconds, self._last_stamp + 1)
        knots = Segment(self._last_stamp, **vars(trajectory))
        self._segment.publish(segment.to_msg(knots))
        self._planning_times.record(planned - began)
        now = time.monotonic()
        self._journal.note(Deed.PLANNED, self._last_stamp, time_s=began, until_s=now)
        self._sequencer.sent(self._last_stamp, trajectory, now - began, now)
        self._tell()
        self.report_health()
        self._show_imagination()

    def health(self) -> Health:
        """Report counters and planning times."""
        if not self.active:
            return Health()
        counters = asdict(self._sequencer.counters)
        times = {f'planning_ms_{k}': v for k, v in self._planning_times.summary_ms().items()}
        values = {
            **counters,
            **times,
            'planning_ms': 1e3 * self._planning_times.last,
            'segment_stamp_ns': self._last_stamp,
            'weights_version': self._watched.watch.in_use.version,
            'weights_refused': self._watched.watch.refusals,
        }
        doubtful = self._doubts()
        level = HealthLevel.WARN if doubtful or counters['invalid_plans'] else HealthLevel.OK
        trouble = self._watched.watch.trouble
        return Health(HealthLevel.ERROR if trouble else level, trouble or doubtful, values)

    def _tell(self) -> None:
        """Tell of weights that are dead: the adapter at once, everybody else once."""
        if self._watched.refusal is not None:
            self._refused.publish(refusal.to_msg(self._watched.refusal))
            self._watched.refusal = None
        trouble = self._watched.watch.trouble
        if trouble and trouble != self._told:
            self.get_logger().error(trouble)
            self.report_health()
        self._told = trouble

    def _doubts(self) -> str:
        if time.monotonic() - self._pose_time > BLIND_S:
            return 'no pose of the arm: nothing is planned'
        if self._stale_in_a_row >= STALE_IN_A_ROW:
            return 'segments are refused as too old: do the clocks of all hosts agree?'
        return ''

    def _on_pose(self, tip: TipPosition) -> None:
        self._pose_time = time.monotonic()
        if self.active:
            self._journal.note(Deed.POSED, tip.stamp_ns)
        self._session.pose(tip.position)

    def _on_executed(self, path: ExecutedPath) -> None:
        self._journal.note(Deed.EXECUTED, path.stamp_ns)
        if self._accepts(self._session.executed, path):
            self._show_waypoints()

    def _on_result(self, ended: SegmentResult) -> None:
        stale = ended.code is ResultCode.STALE
        self._stale_in_a_row = self._stale_in_a_row + 1 if stale else 0
        now = time.monotonic()
        self._journal.note(Deed.ENDED, ended.stamp_ns, ended.digest(), now)
        self._session.result(ended, now)

    def _on_dissonance(self, lesson: Dissonance) -> None:
        self._journal.note(Deed.LEARNED, lesson.segment_stamp_ns)
        self._session.lesson(lesson)

    def _on_weights(self, update: WeightsUpdate) -> None:
        self._journal.note(Deed.WEIGHTS, update.version, update.checksum())
        self._accepts(self._session.weights, update)
        self._tell()

    def _on_waypoints(self, tour: Waypoints) -> None:
        self._journal.note(Deed.TOUR, tour.stamp_ns)
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

    def _show_imagination(self) -> None:
        """Tell what the segment was chosen from, if somebody looks on."""
        listeners = self._samples.get_subscription_count() + self._spikes.get_subscription_count()
        value = self._session.imagination(self._last_stamp) if listeners else None
        if value is not None:
            self._samples.publish(samples.to_msg(value))
            self._spikes.publish(spikes.to_msg(value))

    def _show_waypoints(self) -> None:
        task = self._sequencer.task
        tour = Waypoints(
            self.get_clock().now().nanoseconds, self._workspace.to_metres(task.waypoints)
        )
        self._markers.publish(markers.to_msg(tour, task.active, self._reach_radius))


def main(args: Sequence[str] | None = None) -> int:
    """Run the planner as a process."""
    return run(PlannerNode, args)


if __name__ == '__main__':
    raise SystemExit(main())
