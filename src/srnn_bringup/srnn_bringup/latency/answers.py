# SPDX-License-Identifier: Apache-2.0
"""From a joint state to the command that answers it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.journal import Deed
from srnn_replay.cycles import COMMANDS, MEASURED
from srnn_replay.joint_state_bytes import stamp_ns
from srnn_replay.recording import Recording, Session, of_session

TOPICS = (MEASURED, COMMANDS)

_COMMANDING = (Deed.MEASURED, Deed.ASSUMED)


@dataclass(frozen=True, eq=False)
class Answers:
    """What became of the joint states of a run.

    Attributes:
        times_ms: (n,) from the stamp of a joint state, which the arm sets before it measures,
            to the sending of the command that answers it [ms].
        unanswered: joint states that got no command because a newer one had come.

    """

    times_ms: NDArray[np.float64]
    unanswered: int


def answers(tracker: Recording) -> Answers:
    """Return how soon joint states were answered.

    Args:
        tracker: messages of at least `TOPICS`.

    """
    stamps = np.array([stamp_ns(m.data) for m in tracker.raw(MEASURED)], dtype=np.int64)
    times: list[int] = []
    unanswered = 0
    for session in tracker.sessions:
        found = answered(tracker, session)
        times += [sent - stamp for stamp, sent in found.items()]
        if found:
            due = (stamps >= min(found)) & (stamps <= max(found))
            unanswered += int((due & ~np.isin(stamps, list(found))).sum())
    return Answers(1e-6 * np.array(times, dtype=np.float64), unanswered)


def answered(tracker: Recording, session: Session) -> dict[int, int]:
    """Return when the answers to joint states were sent, by the stamp of the joint state [ns].

    The journal names the joint state of each answer, and the middleware numbers commands. There
    are none if they do not go together: what was not answered, or is not in the bag, is then
    not known.

    Args:
        tracker: messages of at least `TOPICS`.
        session: one process of the tracker.

    """
    rows = [row for row in session.rows.tolist() if row[0] in _COMMANDING]
    sent = {m.sequence: m.sent_ns for m in of_session(tracker.raw(COMMANDS), session)}
    if max(sent, default=0) != len(rows):
        return {}
    return {
        row[1]: sent[number] for number, row in enumerate(rows, start=1)
        if row[0] == Deed.MEASURED and number in sent
    }  # fmt: skip
