# SPDX-License-Identifier: Apache-2.0
"""The decisions of the tracker made again: each command, each path, each result."""

from lwr_description import Kinematics
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.refusal import NOT_IN_CHARGE, Refusal
from lwr_tracking.core.tracking_session import TrackingSession
from lwr_tracking.joint_pairing import MAX_LAG
from srnn_bag import Message
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.ros import executed, joints, result, segment
from srnn_replay.errors import NotReplayableError
from srnn_replay.inputs import Inputs
from srnn_replay.joint_state_bytes import JointStateBytes, Row, last_numbers, stamp_ns
from srnn_replay.origin import RunOrigin
from srnn_replay.recording import Recording, Session, of_session
from srnn_replay.verdict import Told, Verdict, said_in

NODE = 'tracker'
MEASURED = 'joint_states'
EXTERNAL = 'external_torque/joint_states'
COMMANDS = 'forward_position_controller/commands'
_MEASURED = int(Deed.MEASURED)
TOPICS = ('segment', MEASURED, EXTERNAL, COMMANDS, 'executed', 'segment_result')


class TrackerReplay:
    """Feeds a tracker what the tracker of a recording has acted on."""

    def __init__(self, recording: Recording, origin: RunOrigin) -> None:
        """Read the inputs."""
        told = origin.tracker()
        self._kinematics = Kinematics(told.mount)
        self._recording = recording
        self._by_stamp: dict[str, dict[int, Message]] = {}
        self._measured, self._external = self._rows(MEASURED), self._rows(EXTERNAL)
        self._segments = Inputs(recording, 'segment', segment.from_msg, lambda v: v.stamp_ns)
        self._tracking = TrackingSession(told.tracking, self._kinematics)
        self._sample: JointSample | None = None

    def run(self) -> Verdict:
        """Make all decisions again, until one differs."""
        verdict = Verdict(NODE)
        for session in self._recording.sessions:
            self._listen(session, verdict)
            deeds, first, second, *_ = session.rows.T.tolist()
            if not all(map(self._act, deeds, first, second, session.times)):
                break
            end_ns = self._sample.stamp_ns if self._sample else session.began_ns
            if not all(told.finish(end_ns) for told in (self._paths, self._results)):
                break
        return verdict

    def _listen(self, session: Session, verdict: Verdict) -> None:
        """Begin with what one process has said."""
        said = of_session(self._recording.raw(COMMANDS), session)
        numbers = last_numbers([m.data for m in said], len(self._kinematics.joints))
        self._commands = Told(
            'commands', [*zip(said, numbers, strict=True)], lambda _: 'a command', verdict
        )
        paths, results = (
            said_in(session, self._recording.decoded(topic, convert))
            for topic, convert in (
                ('executed', executed.from_msg), ('segment_result', result.from_msg),
            )
        )  # fmt: skip
        results = [(m, value) for m, value in results if value.reason != NOT_IN_CHARGE]
        self._paths = Told('paths', paths, lambda v: f'path of segment {v.stamp_ns}', verdict)
        self._results = Told(
            'results', results, lambda v: f'result of segment {v.stamp_ns}', verdict
        )

    def _act(self, deed: int, first: int, second: int, time: float) -> bool:
        """Do again what one row tells; return whether to go on."""
        if deed == _MEASURED:
            return self._tick(time, self._joint_sample(first, first + second))
        match deed:
            case Deed.ASSUMED:
                assert self._sample is not None
                return self._tick(time, self._tracking.assumed(self._sample, first))
            case Deed.OFFERED:
                refused = self._tracking.offer(self._segments[first], time)
                return (
                    refused is None
                    or refused.reason == Refusal.DUPLICATE
                    or self._results.compare(result.from_msg(result.to_msg(refused)))
                )
            case Deed.ACTIVATED:
                self._tracking.begin(Condition(first))
            case Deed.SILENT:
                self._tracking.silence()
            case Deed.STOP:
                self._tracking.stop()
            case Deed.RESET:
                self._tracking.reset()
            case Deed.PAUSE:
                self._tracking.pause()
            case Deed.RESUME:
                self._tracking.resume()
        return True

    def _tick(self, now: float, sample: JointSample) -> bool:
        self._sample = sample
        command, finished = self._tracking.tick(now, sample)
        if command is not None and not self._commands.compare(command):
            return False
        for end in finished:
            if end.path is not None:
                path = executed.from_msg(executed.to_msg(end.path))
                if not self._paths.compare(path):
                    return False
            if not self._results.compare(result.from_msg(result.to_msg(end.result))):
                return False
        return True

    def _rows(self, name: str) -> dict[int, Row]:
        """Return what the joint states of a topic say, by their stamps, where known how."""
        data = [message.data for message in self._recording.raw(name)]
        rows = JointStateBytes(self._kinematics.joints).rows(data)
        stamps = map(stamp_ns, data)
        return {s: row for s, row in zip(stamps, rows, strict=True) if row is not None}

    def _joint_sample(self, stamp: int, external_stamp: int) -> JointSample:
        own, others = self._measured.get(stamp), self._external.get(external_stamp)
        if own is None or others is None:
            return self._general_sample(stamp, external_stamp)
        position, velocity, torque = own
        return JointSample(
            stamp, position, velocity, torque, others[2], external_stamp - stamp
        )

    def _general_sample(self, stamp: int, external_stamp: int) -> JointSample:
        try:
            measured, external = (
                self._recording.message(name, self._messages(name)[when])
                for name, when in ((MEASURED, stamp), (EXTERNAL, external_stamp))
            )
        except KeyError:
            raise NotReplayableError(
                f'{NODE}: the bag lacks joint states {stamp}, which it has answered'
            ) from None
        return joints.from_msgs(measured, external, self._kinematics.joints, MAX_LAG)

    def _messages(self, name: str) -> dict[int, Message]:
        """Return the joint states of a topic by their stamps."""
        if name not in self._by_stamp:
            messages = self._recording.raw(name)
            self._by_stamp[name] = {stamp_ns(message.data): message for message in messages}
        return self._by_stamp[name]
