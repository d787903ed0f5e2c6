# SPDX-License-Identifier: Apache-2.0
"""The decisions of the tracker made again: each command, each path, each result."""

from concurrent.futures import ProcessPoolExecutor
import multiprocessing

from lwr_description import Kinematics
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.refusal import NOT_IN_CHARGE, Refusal
from lwr_tracking.core.tracking_session import TrackingSession
from lwr_tracking.joint_pairing import MAX_LAG
from srnn_bag import Message
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.ros import executed, joints, result, segment
from srnn_replay import cycles
from srnn_replay.cycles import EXTERNAL, MEASURED, read_cycles
from srnn_replay.errors import FROM_THE_START, NotReplayableError
from srnn_replay.inputs import Inputs
from srnn_replay.joint_state_bytes import stamps_ns
from srnn_replay.origin import RunOrigin
from srnn_replay.recording import Recording, Session, full_names, unmarked
from srnn_replay.verdict import Told, Verdict, said_in

NODE = 'tracker'
TOPICS = ('segment', 'executed', 'segment_result')

_MEASURED = int(Deed.MEASURED)


class TrackerReplay:
    """Feeds a tracker what the tracker of a recording has acted on."""

    def __init__(self, origin: RunOrigin, prefix: str) -> None:
        """Read the inputs of a graph, whose names begin with `prefix`."""
        told = origin.tracker()
        self._kinematics = Kinematics(told.mount)
        self._bag = origin.bag
        self._names = full_names(self._bag, cycles.TOPICS, prefix)
        # Most of the bag is read beside all the rest.
        with ProcessPoolExecutor(1, multiprocessing.get_context('fork')) as reader:
            coming = reader.submit(read_cycles, self._bag, self._names, self._kinematics.joints)
            self._recording = Recording(self._bag, NODE, TOPICS, prefix)
            self._segments = Inputs.read(
                self._recording, 'segment', segment.from_msg, lambda v: v.stamp_ns
            )
            self._said_paths, self._said_results = (
                self._recording.decoded('executed', executed.from_msg),
                self._recording.decoded('segment_result', result.from_msg),
            )
            self._tracking = TrackingSession(told.tracking, self._kinematics)
            self._cycles = coming.result()
        self._measured = [*map(tuple, self._cycles.measured.numbers)]
        self._external = [*self._cycles.external.numbers[:, 0]]
        self._unusual: dict[str, dict[int, Message]] = {}
        self._sample: JointSample | None = None

    def run(self) -> Verdict:
        """Make all decisions again, until one differs."""
        verdict = Verdict(NODE)
        for session in self._recording.sessions:
            self._listen(session, verdict)
            deeds, first, second, *_ = session.rows.T
            own = self._cycles.measured.places(first)
            others = self._cycles.external.places(first + second)
            rows = deeds.tolist(), first.tolist(), second.tolist(), session.times, own, others
            if not all(map(self._act, *rows)):
                break
            end_ns = self._sample.stamp_ns if self._sample else session.began_ns
            if not all(told.finish(end_ns) for told in (self._paths, self._results)):
                break
        return verdict

    def _listen(self, session: Session, verdict: Verdict) -> None:
        """Begin with what one process has said."""
        said = [
            (sent_ns, command)
            for sent_ns, command in zip(
                self._cycles.sent_ns, self._cycles.commands, strict=True
            )
            if session.has(sent_ns)
        ]
        self._commands = Told('commands', said, lambda _: 'a command', verdict)
        paths, results = (said_in(session, s) for s in (self._said_paths, self._said_results))
        results = [(sent_ns, value) for sent_ns, value in results if value.reason != NOT_IN_CHARGE]
        self._paths = Told('paths', paths, lambda v: f'path of segment {v.stamp_ns}', verdict)
        self._results = Told(
            'results', results, lambda v: f'result of segment {v.stamp_ns}', verdict
        )

    def _act(
        self, deed: int, first: int, second: int, time: float, own: int, others: int
    ) -> bool:
        """Do again what one row tells; return whether to go on.

        Args:
            deed: what was done.
            first: see `Deed`.
            second: see `Deed`.
            time: steady-clock time, or an age [s].
            own: which of the joint states `first` is, if any; -1 for none.
            others: the same of external torques `second` ns later.

        """
        if deed == _MEASURED:
            if own < 0 or others < 0:
                return self._tick(time, self._general_sample(first, first + second))
            position, velocity, torque = self._measured[own]
            external = self._external[others]
            sample = JointSample(first, position, velocity, torque, external, second)
            return self._tick(time, sample)
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

    def _general_sample(self, stamp: int, external_stamp: int) -> JointSample:
        """Return joint states whose bytes are not as usual."""
        try:
            measured, external = (
                unmarked(name, self._by_stamp(name)[when])
                for name, when in ((MEASURED, stamp), (EXTERNAL, external_stamp))
            )
        except KeyError:
            late = stamp < min(self._by_stamp(MEASURED), default=stamp)
            advice = f'; {FROM_THE_START}' if late else ''
            raise NotReplayableError(
                f'{NODE}: the bag lacks joint states {stamp}, which it has answered{advice}'
            ) from None
        return joints.from_msgs(measured, external, self._kinematics.joints, MAX_LAG)

    def _by_stamp(self, name: str) -> dict[int, Message]:
        """Return the joint states of a topic by their stamps."""
        if name not in self._unusual:
            messages = [*self._bag.messages({self._names[name]})]
            stamps = stamps_ns([message.data for message in messages]).tolist()
            self._unusual[name] = dict(zip(stamps, messages, strict=True))
        return self._unusual[name]
