# SPDX-License-Identifier: Apache-2.0
"""What is said in every cycle of the arm, by columns: most of a bag, read in a few steps."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_bag import Bag, Message
from srnn_replay.joint_state_bytes import JointStateBytes, last_numbers, stamps_ns

MEASURED = 'joint_states'
EXTERNAL = 'external_torque/joint_states'
COMMANDS = 'forward_position_controller/commands'
TOPICS = (MEASURED, EXTERNAL, COMMANDS)

WANTED = {MEASURED: ('position', 'velocity', 'effort'), EXTERNAL: ('effort',)}
"""What a tracker wants to know of joint states."""


@dataclass(frozen=True, eq=False)
class JointStates:
    """The joint states of a topic whose bytes could be read, in the order of their stamps.

    Attributes:
        stamps_ns: (n,) [ns].
        numbers: (n, fields, joints) as in `WANTED`.

    """

    stamps_ns: NDArray[np.int64]
    numbers: NDArray[np.float64]

    def places(self, stamps_ns: NDArray[np.int64]) -> list[int]:
        """Return where the joint states of some stamps (k,) are; -1 for none."""
        if not len(self.stamps_ns):
            return [-1] * len(stamps_ns)
        # Of several with one stamp, the last.
        places = np.searchsorted(self.stamps_ns, stamps_ns, side='right') - 1
        found: list[int] = np.where(self.stamps_ns[places] == stamps_ns, places, -1).tolist()
        return found


@dataclass(frozen=True, eq=False)
class Cycles:
    """What is said in every cycle.

    Attributes:
        measured: angles, velocities and torques.
        external: the arm's estimate of external torques.
        sent_ns: when each command was sent [ns of system time].
        commands: their joint angles, (joints,) each [rad].

    """

    measured: JointStates
    external: JointStates
    sent_ns: list[int]
    commands: Iterable[NDArray[np.float64]]


def read_cycles(bag: Bag, names: Mapping[str, str], joints: Sequence[str]) -> Cycles:
    """Read what is said in every cycle.

    Args:
        bag: where from.
        names: full names of `TOPICS`.
        joints: their names, in order.

    Raises:
        BagFormatError: a part of the bag is damaged.

    """
    messages: dict[str, list[Message]] = {full: [] for full in names.values()}
    for message in bag.messages(messages.keys()):
        messages[message[0]].append(message)
    measured, external = (
        _joint_states([m.data for m in messages[names[topic]]], joints, WANTED[topic])
        for topic in (MEASURED, EXTERNAL)
    )
    said = messages[names[COMMANDS]]
    commands = last_numbers([message.data for message in said], len(joints))
    return Cycles(measured, external, [message.sent_ns for message in said], commands)


def _joint_states(
    data: Sequence[bytes], joints: Sequence[str], fields: Sequence[str]
) -> JointStates:
    known, numbers = JointStateBytes(joints).columns(data, fields)
    stamps = stamps_ns(data)
    order = np.argsort(stamps, kind='stable')
    order = order[known[order]]
    return JointStates(stamps[order], numbers[order])
