# SPDX-License-Identifier: Apache-2.0
"""The tracker: executes segments on the arm and stops on contact."""

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
import time
from typing import Any

import numpy as np
from std_srvs.srv import Trigger

from lwr_description import Kinematics, Mount
from lwr_tracking.core.failsafe import Condition, decide
from lwr_tracking.core.parameters import TrackerParameters
from lwr_tracking.core.refusal import Refusal
from lwr_tracking.core.tracker import Tracker
from lwr_tracking.latch_file import LatchFile
from srnn_config import Parameters, parameter
from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import commands, executed, joints, pose, result, segment
from srnn_msgs_py.segment import Segment
from srnn_msgs_py.tip import TipPosition
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.run import run

PRIORITY = 49
"""SCHED_FIFO priority to ask for."""

MAX_LAG = 0.01
"""Largest difference in time between joint state and external torque [s]."""

SILENCE = 1.0
"""Without joint states for this long the tracker stops until reset [s], whoever has slept.

Until then it just waits: without a joint state there is no command, and the arm holds.
"""

TICKS_PER_POSE = 5
"""One pose goes out for this many measurements: 50 Hz of 250 Hz."""

LONGEST_STOP = 1.0
"""No deactivation takes longer than this to bring the arm to rest [s]."""

NOT_IN_CHARGE = 'another planner is in charge'
"""Reason for a planner whose segments are not looked at while those of another are."""


@dataclass(frozen=True)
class TrackerNodeParameters(Parameters):
    """Parameters of the tracker node."""

    latch: str = parameter(
        '', doc='File that keeps what has stopped the arm until reset, so that a successor does '
        'not move it either; empty for none.',
    )
    mount: Mount = field(default_factory=Mount)
    tracking: TrackerParameters = field(default_factory=TrackerParameters)


class TrackerNode(WorkspaceNode):
    """One joint command for each joint state while active; inactive it commands nothing."""

    PARAMETERS = TrackerNodeParameters

    def __init__(self) -> None:
        """Create the node, unconfigured."""
        super().__init__('tracker')
        self._latched = Condition.NONE

    def configure(self, parameters: TrackerNodeParameters) -> None:
        """Build the arm's kinematics, connect topics and services."""
        self._settings = parameters.tracking
        self._latch = LatchFile(Path(parameters.latch) if parameters.latch else None)
        self._latched = self._latch.read()
        self._kinematics = Kinematics(parameters.mount)
        Tracker(self._settings, self._kinematics)  # Compiles what activation must not wait for.
        self.keep_journal('tracker/journal')
        self._external: Any = None
        self._sample: JointSample | None = None
        self._arrival = 0.0
        self._longest_silence = 0.0
        self._ticks = 0
        # The oldest command is as old as the arm is behind its commands.
        self._sent: deque[np.ndarray] = deque(
            maxlen=max(1, round(self._settings.law.lead / self._settings.period))
        )
        self._commands = self.advertise('forward_position_controller/commands')
        self._executed = self.advertise('executed')
        self._results = self.advertise('segment_result')
        self._pose = self.advertise('current_pose')
        self.listen('external_torque/joint_states', lambda msg: msg, self._on_external)
        self.listen('joint_states', self._pair, self._on_sample)
        self.listen('segment', segment.from_msg, self._on_segment, self._on_foreign_segment)
        for name in ('stop', 'reset', 'pause', 'resume'):
            self.create_service(Trigger, f'~/{name}', self._service(getattr(self, f'_{name}')))

    def activate(self) -> None:
        """Hold the arm where it is; segments are accepted from the first measurement on."""
        self._tracker = Tracker(self._settings, self._kinematics)
        # Joint states are heard while inactive as well: the watch on them begins now.
        self._sample = None
        self._tracker.restore(self._latched)
        self._journal.note(Deed.ACTIVATED, self._latched.value)

    def deactivate(self) -> None:
        """Bring the arm to rest on its path, then command nothing more."""
        self._pause()
        period = self._settings.period
        until = time.monotonic() + LONGEST_STOP
        while self._sample is not None and time.monotonic() < until:
            reference = self._tracker.reference
            if reference is None or reference.at_rest:
                break
            # No measurement can arrive in here: assume that the arm follows its commands.
            time.sleep(period)
            stamp_ns = self._sample.stamp_ns + round(1e9 * period)
            self._sample = replace(self._sample, stamp_ns=stamp_ns, position=self._sent[0])
            self._cycle(self._sample, Deed.ASSUMED)

    def seconds_to_tick(self) -> float | None:
        """Return when the joint states are overdue [s]."""
        if self._sample is None:
            return None
        return self._arrival + SILENCE - time.monotonic()

    def on_tick(self) -> None:
        """Stop: without joint states nobody knows where the arm is."""
        self._sample = None
        self._silence()
        self._tell()

    def health(self) -> Health:
        """Report conditions, counters and the last measurement."""
        if not self.active:
            causes = decide(self._latched).causes
            return Health(HealthLevel.ERROR if causes else HealthLevel.OK, ', '.join(causes))
        counters = asdict(self._tracker.counters)
        refused = {f'refused_{reason.name.lower()}': n for reason, n in
                   counters.pop('refused').items()}
        values = {
            **counters, **refused,
            'force_n': self._tracker.contact.force,
            'error_m': self._tracker.contact.error,
            'longest_silence_ms': 1e3 * self._longest_silence,
        }
        if self._sample is None:
            return Health(HealthLevel.ERROR, 'no joint states', values)
        decision = decide(self._tracker.conditions)
        level = HealthLevel.WARN if decision.causes else HealthLevel.OK
        level = HealthLevel.ERROR if decision.latched else level
        return Health(level, ', '.join(decision.causes), values)

    def _pair(self, msg: Any) -> JointSample:
        if self._external is None:
            raise MessageError('no external torque yet')
        return joints.from_msgs(msg, self._external, self._kinematics.joints, MAX_LAG)

    def _on_external(self, msg: Any) -> None:
        self._external = msg

    def _on_sample(self, sample: JointSample) -> None:
        now = time.monotonic()
        silence = 0.0 if self._sample is None else now - self._arrival
        self._longest_silence = max(self._longest_silence, silence)
        self._sample, self._arrival = sample, now
        if not self.active:
            return
        if silence > SILENCE:
            # A process that has slept may find this one before its own watch.
            self._silence()
        self._cycle(sample, Deed.MEASURED)

    def _silence(self) -> None:
        self._journal.note(Deed.SILENT)
        self._tracker.silence()

    def _tell(self) -> None:
        """Log what has stopped the arm until reset, once, and keep it for a successor."""
        latched = decide(self._tracker.conditions).latched
        if latched == self._latched:
            return
        if latched & ~self._latched:
            causes = ', '.join(decide(latched).causes)
            self.get_logger().error(f'frozen until reset: {causes}')
        self._keep(latched)

    def _keep(self, latched: Condition) -> None:
        self._latched = latched
        try:
            self._latch.write(latched)
        except OSError as error:
            self.get_logger().error(f'latch: {error}')

    def _cycle(self, sample: JointSample, deed: Deed) -> None:
        now = time.monotonic()
        self._journal.note(deed, sample.stamp_ns, sample.lag_ns, now)
        tick = self._tracker.tick(now, sample)
        self._tell()
        # Whoever reports again after a silence may be another arm: it is told nothing yet.
        if tick.command is not None and Condition.SILENT not in self._tracker.conditions:
            self._sent.append(tick.command)
            self._commands.publish(commands.to_msg(tick.command))
        for end in tick.finished:
            if end.path is not None:
                self._executed.publish(executed.to_msg(end.path))
            self._results.publish(result.to_msg(end.result))
        self._ticks += 1
        if self._ticks % TICKS_PER_POSE == 0:
            self._pose.publish(pose.to_msg(TipPosition(sample.stamp_ns, self._tracker.tip)))

    def _on_segment(self, value: Segment) -> None:
        if not self.active:
            return
        age = 1e-9 * (self.get_clock().now().nanoseconds - value.stamp_ns)
        self._journal.note(Deed.OFFERED, value.stamp_ns, time_s=age)
        refused = self._tracker.offer(value, age)
        # A duplicate has the identity of a segment that may well be running.
        if refused is not None and refused.reason != Refusal.DUPLICATE:
            self._results.publish(result.to_msg(refused))

    def _on_foreign_segment(self, value: Segment) -> None:
        """Tell a planner that it has to wait, so that it need not find out by itself."""
        if self.active:
            refused = SegmentResult(value.stamp_ns, ResultCode.REJECTED, NOT_IN_CHARGE, {})
            self._results.publish(result.to_msg(refused))

    def _stop(self) -> str:
        if not self.active:
            self._keep(self._latched | Condition.STOPPED)
            return 'frozen until reset, once it is active'
        self._journal.note(Deed.STOP)
        self._tracker.stop()
        self._tell()
        return 'frozen until reset'

    def _reset(self) -> str:
        self._journal.note(Deed.RESET)
        self._tracker.reset()
        self._tell()
        return 'ready; the arm holds until the next segment'

    def _pause(self) -> str:
        self._journal.note(Deed.PAUSE)
        self._tracker.pause()
        return 'coming to rest on the path'

    def _resume(self) -> str:
        self._journal.note(Deed.RESUME)
        self._tracker.resume()
        return 'going on'

    def _service(self, action: Callable[[], str]) -> Callable[..., Trigger.Response]:
        def answer(_: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
            # Nobody must have to know in which state it is to stop the arm.
            possible = self.active or action == self._stop
            response.success = possible
            response.message = action() if possible else f'the tracker is {self.state}'
            return response

        return answer


def main(args: Sequence[str] | None = None) -> int:
    """Run the tracker as a process."""
    return run(TrackerNode, args, priority=PRIORITY)


if __name__ == '__main__':
    raise SystemExit(main())
