# SPDX-License-Identifier: Apache-2.0
"""What a user may choose of a graph; pure, so that a command line is read without delay."""

from dataclasses import dataclass
from pathlib import Path

STANDARD_SCENE = 'four_waypoints'
NETWORK = 'network'
ARM_DESCRIPTION = 'lwr4p'

SIMULATED = 'sim'
FRI = 'fri'

ROOT = '/'
"""The namespace of a graph that has no other."""

SEED_MAX = 2**31 - 1


@dataclass(frozen=True)
class Choices:
    """What the command line decides; None leaves it to the files.

    Attributes:
        arm: name of an arm, see `srnn_bringup.arms`.
        emulated: whether its controller is emulated.
        description: name of an arm description in the configuration, or path of its file.
        scene: name of a scene in the configuration, or path of a scene file.
        network: name of a network in the configuration, or path of its file.
        signal: learning signal.
        alpha: rate of the constant learning signals.
        seed: seed of all random numbers.
        initial_weights: weight file to start from.
        weights_file: weight file that is written.
        key_file: file with the key that the nodes share.
        keystore: directory of the keystore that protects the graph.
        namespace: absolute ROS namespace of the nodes.
        remappings: names of topics and services, and what the nodes use instead.

    """

    arm: str = SIMULATED
    emulated: bool = False
    description: str = ARM_DESCRIPTION
    scene: str = STANDARD_SCENE
    network: str = NETWORK
    signal: str | None = None
    alpha: float | None = None
    seed: int = 0
    initial_weights: Path | None = None
    weights_file: Path | None = None
    key_file: Path | None = None
    keystore: Path | None = None
    namespace: str = ROOT
    remappings: tuple[tuple[str, str], ...] = ()
