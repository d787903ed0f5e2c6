# SPDX-License-Identifier: Apache-2.0
"""What a bag carries besides messages: all that a run can be repeated from."""

from collections.abc import Mapping
import json
from pathlib import Path
import sys
from typing import Any

from srnn_bag import Attachment
from srnn_bag.attached import PARAMETERS, RUN, SCENE, START_WEIGHTS
from srnn_bringup.config import Configuration
from srnn_replay.code_version import code_version

YAML = 'application/yaml'


def of_run(configuration: Configuration, parameters: Mapping[str, Path]) -> list[Attachment]:
    """Return the files of a graph that is started; keys are not among them.

    Args:
        configuration: what the nodes are told.
        parameters: parameter file of every node, by name.

    """
    files = [
        summary(
            arm=configuration.robot, emulated=configuration.emulated, seed=configuration.seed,
            nodes=list(parameters),
        ),
        of_scene(configuration.scene_path),
        *(of_node(name, file.read_bytes()) for name, file in parameters.items()),
    ]  # fmt: skip
    if configuration.initial_weights is not None:
        files.append(of_weights(configuration.initial_weights))
    return files


def summary(**more: Any) -> Attachment:
    """Return what code runs, by which command, and what else there is to say."""
    run = {'versions': code_version(), 'command': sys.argv[1:], **more}
    return Attachment(RUN, 'application/json', json.dumps(run, indent=1).encode())


def of_node(name: str, content: bytes) -> Attachment:
    """Return the parameter file of a node."""
    return Attachment(PARAMETERS.format(name), YAML, content)


def of_scene(path: Path) -> Attachment:
    """Return a scene file."""
    return Attachment(SCENE, YAML, path.read_bytes())


def of_weights(path: Path) -> Attachment:
    """Return the weights that learning starts from."""
    return Attachment(START_WEIGHTS, 'application/octet-stream', path.read_bytes())
