# SPDX-License-Identifier: Apache-2.0
"""The graph as data: its nodes, where they live, and what each of them is told."""

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

from srnn_bringup.arms import ARM_NODES, describe_arm
from srnn_bringup.errors import ChoiceError
from srnn_bringup.node_description import NodeDescription
from srnn_config import to_mapping
from srnn_config.nearest import did_you_mean

if TYPE_CHECKING:
    from srnn_bringup.config import Configuration

BRAIN = ('tracker', 'adapter', 'planner')
"""The nodes that are the same for every arm."""

NAMES = (*ARM_NODES, *BRAIN)
"""Names of all nodes that a graph may have, in the order in which they are brought up."""

CHECKPOINT = 'checkpoint.npz'
"""Name of the file from which a restarted adapter goes on."""

LATCH = 'latch'
"""Name of the file that keeps a restarted tracker from moving an arm that was stopped."""


def describe(
    configuration: 'Configuration', directory: Path | None = None
) -> tuple[NodeDescription, ...]:
    """Return the nodes in the order in which they are brought up.

    The arm comes first and the planner last: whoever starts to send finds its
    listeners ready, and nothing moves before all of them are.

    Args:
        configuration: what the nodes are told.
        directory: where nodes keep what a successor must know, None for nowhere.

    """
    scene = str(configuration.scene_path)
    seed = configuration.seed
    network = to_mapping(configuration.network)
    return (
        *describe_arm(configuration),
        NodeDescription(
            'tracker', 'lwr_tracking', 'tracker', 'lwr_tracking.tracker_node',
            {
                'latch': _text(directory, LATCH),
                'mount': to_mapping(configuration.arm.mount),
                'tracking': to_mapping(configuration.tracker),
            },
        ),
        NodeDescription(
            'adapter', 'srnn_planner', 'adapter', 'srnn_planner.nodes.adapter_node',
            {
                'seed': seed,
                'initial_weights': _text(configuration.initial_weights),
                'weights_file': _text(configuration.weights_file),
                'checkpoint': _text(directory, CHECKPOINT),
                'model': network['model'],
            },
        ),
        NodeDescription(
            'planner', 'srnn_planner', 'planner', 'srnn_planner.nodes.planner_node',
            {'scene': scene, 'seed': seed, **network},
        ),
    )  # fmt: skip


def access(configuration: 'Configuration') -> dict[str, str]:
    """Return the parameters by which every node knows whom to believe."""
    return {'key_file': _text(configuration.key_file)}


def part(text: str) -> tuple[str, ...]:
    """Return the names in a list with commas, in the order in which they are brought up.

    Raises:
        ChoiceError: a name is of no node; the message lists those there are.

    """
    chosen = [name.strip() for name in text.split(',')]
    for name in chosen:
        if name not in NAMES:
            hint = did_you_mean(name, NAMES)
            raise ChoiceError(f'unknown node {name!r}{hint}; nodes: {", ".join(NAMES)}')
    return tuple(name for name in NAMES if name in chosen)


def chosen(
    configuration: 'Configuration', names: Collection[str], directory: Path | None = None
) -> tuple[NodeDescription, ...]:
    """Return those nodes of the graph that were chosen, all if none was.

    Raises:
        ChoiceError: a chosen one is not in this graph; the message lists those that are.

    """
    nodes = describe(configuration, directory)
    there = [node.name for node in nodes]
    for name in names:
        if name not in there:
            raise ChoiceError(
                f"'{name}' is no node of arm '{configuration.robot}'; nodes: {', '.join(there)}"
            )
    return tuple(node for node in nodes if not names or node.name in names)


def complete(seen: Collection[str]) -> bool:
    """Tell whether nodes of these names are a whole graph, whatever its arm is."""
    return set(BRAIN) <= set(seen) and not set(ARM_NODES).isdisjoint(seen)


def write_parameters(
    nodes: Sequence[NodeDescription], directory: Path, **extra: Any
) -> dict[str, Path]:
    """Write one ROS parameter file per node.

    Args:
        nodes: nodes of the graph.
        directory: existing directory to write to.
        extra: parameters that every node gets besides its own.

    Returns:
        The file of every node, by name.

    """
    files = {}
    for node in nodes:
        files[node.name] = directory / f'{node.name}.yaml'
        # Any name matches, so that the graph can be put into a namespace.
        content = {'/**': {'ros__parameters': {**node.parameters, **extra}}}
        files[node.name].write_text(
            yaml.safe_dump(content, sort_keys=False, allow_unicode=True), encoding='utf-8'
        )
    return files


def _text(path: Path | None, name: str = '') -> str:
    return '' if path is None else str(path / name)
