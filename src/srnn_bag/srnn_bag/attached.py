# SPDX-License-Identifier: Apache-2.0
"""Files that a bag of a run has attached, and their names."""

from dataclasses import dataclass

RUN = 'run.json'
"""What code ran, by which command, on what arm, with which seed."""

SCENE = 'scene.yaml'
START_WEIGHTS = 'start_weights.npz'

PARAMETERS = 'parameters/{}.yaml'
"""ROS parameter file of a node."""

REMAPPED = 'remapped.json'
"""Topics that were remapped: the full name that each would have had, and the one it has."""


@dataclass(frozen=True)
class Attachment:
    """A file that a bag carries with it."""

    name: str
    media_type: str
    data: bytes
