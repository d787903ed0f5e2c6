# SPDX-License-Identifier: Apache-2.0
"""The tracker: executes segments on the arm and stops on contact."""

from collections.abc import Callable, Sequence
from functools import partial
import time

from lwr_description import Kinematics
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.refusal import Refusal
from lwr_tracking.core.silence_watch import SilenceWatch
from lwr_tracking.core.tracker_health import health_at_rest, health_at_work
from lwr_tracking.core.tracking_session import TrackingSession
from lwr_tracking.joint_pairing import JointPairing
from lwr_tracking.latch import Latch
from lwr_tracking.node_parameters import TrackerNodeParameters
from lwr_tracking.tracker_topics import TrackerTopics
from srnn_msgs_py.health import Health
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.ros import segment
from srnn_msgs_py.segment import Segment
from srnn_node import trigger
from srnn_node.errors import NotNowError
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.run import run

PRIORITY = 49
"""SCHED_FIFO priority to ask for."""

LONGEST_STOP = 1.0
"""No deactivation takes longer than this to bring the arm to rest [s]."""


class TrackerNode(WorkspaceNode):
    """One joint command for each joint state while active; inactive it commands nothing."""

    PARAMETERS = TrackerNodeParameters

    def __init__(self) -> None:
        """Create the node, unconfigured."""
        super().__init__('tracker')
        self._latch = Latch('', self._complain)

    def configure(self, parameters: TrackerNodeParameters) -> None:
        """Build the arm's kinematics, connect topics and services."""
        self._latch = Latch(parameters.latch, self._complain)
        self._period = parameters.tracking.period
        kinematics = Kinematics(parameters.mount)
        self.keep_journal('tracker/journal')
        self._session = TrackingSession(parameters.tracking, kinematics, self._journal.note)
        self._watch = SilenceWatch()
        self._pairing = JointPairing(kinematics.joints)
        self._topics = TrackerTopics(self)
        self.listen('external_torque/joint_states', lambda msg: msg, self._pairing.keep)
        self.listen('joint_states', self._pairing.pair, self._on_sample)
        self.listen('segment', segment.from_msg, self._on_segment, self._on_foreign_segment)
        # Nobody must have to know in which state it is to stop the arm.
        trigger.offer(self, 'stop', self._stop)
        for name, action, done in (
            ('reset', self._reset, 'ready; the arm holds until the next segment'),
            ('pause', self._session.pause, 'coming to rest on the path'),
            ('resume', self._session.resume, 'going on'),
        ):
            trigger.offer(self, name, partial(self._if_active, action, done))

    def activate(self) -> None:
        """Hold the arm where it is; segments are accepted from the first measurement on."""
        # Joint states are heard while inactive as well: the watch on them begins now.
        self._watch.begin()
        self._session.begin(self._latch.conditions)

    def deactivate(self) -> None:
        """Bring the arm to rest on its path, then command nothing more."""
        self._session.pause()
        sample, until = self._watch.sample, time.monotonic() + LONGEST_STOP
        while sample is not None and not self._session.at_rest and time.monotonic() < until:
            # No measurement can arrive in here: assume that the arm follows its commands.
            time.sleep(self._period)
            sample = self._session.assumed(sample, sample.stamp_ns + round(1e9 * self._period))
            self._cycle(sample, Deed.ASSUMED)

    def seconds_to_tick(self) -> float | None:
        """Return when the joint states are overdue [s]."""
        return self._watch.seconds_left(time.monotonic())

    def on_tick(self) -> None:
        """Stop: without joint states nobody knows where the arm is."""
        self._watch.begin()
        self._session.silence()
        self._tell()

    def health(self) -> Health:
        """Report conditions, counters and the last measurement."""
        if not self.active:
            return health_at_rest(self._latch.conditions)
        return health_at_work(self._session.tracker, self._watch)

    def _complain(self, text: str) -> None:
        self.get_logger().error(text)

    def _tell(self) -> None:
        self._latch.follow(self._session.tracker.conditions)

    def _on_sample(self, sample: JointSample) -> None:
        late = self._watch.heard(sample, time.monotonic())
        if not self.active:
            return
        if late:
            self._session.silence()
        self._cycle(sample, Deed.MEASURED)

    def _cycle(self, sample: JointSample, deed: Deed) -> None:
        tick = self._session.tick(time.monotonic(), sample, deed)
        self._tell()
        self._topics.answer(tick, sample.stamp_ns, self._session.tracker.tip)

    def _on_segment(self, value: Segment) -> None:
        if not self.active:
            return
        age = 1e-9 * (self.get_clock().now().nanoseconds - value.stamp_ns)
        refused = self._session.offer(value, age)
        # A duplicate has the identity of a segment that may well be running.
        if refused is not None and refused.reason != Refusal.DUPLICATE:
            self._topics.result(refused)

    def _on_foreign_segment(self, value: Segment) -> None:
        if self.active:
            self._topics.not_in_charge(value)

    def _if_active(self, action: Callable[[], None], done: str) -> str:
        if not self.active:
            raise NotNowError(f'the tracker is {self.state}')
        action()
        return done

    def _stop(self) -> str:
        if not self.active:
            self._latch.add(Condition.STOPPED)
            return 'frozen until reset, once it is active'
        self._session.stop()
        self._tell()
        return 'frozen until reset'

    def _reset(self) -> None:
        self._session.reset()
        self._tell()


def main(args: Sequence[str] | None = None) -> int:
    """Run the tracker as a process."""
    return run(TrackerNode, args, priority=PRIORITY)


if __name__ == '__main__':
    raise SystemExit(main())
