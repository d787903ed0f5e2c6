# SPDX-License-Identifier: Apache-2.0
"""How much of the time of a segment its planning takes."""

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.journal import Deed, number
from srnn_msgs_py.ros import segment
from srnn_replay.recording import Recording

TOPICS = ('segment',)


def planning_shares(planner: Recording) -> NDArray[np.float64]:
    """Return planning and sending of each segment that was sent, as a share (n,) of its duration.

    Args:
        planner: messages of at least `TOPICS`.

    """
    durations = {
        d.value.stamp_ns: d.value.duration for d in planner.decoded('segment', segment.from_msg)
    }
    return np.array([
        (number(row[4]) - number(row[3])) / durations[row[1]]
        for session in planner.sessions for row in session.rows.tolist()
        if row[0] == Deed.PLANNED and row[1] in durations
    ], dtype=np.float64)  # fmt: skip
