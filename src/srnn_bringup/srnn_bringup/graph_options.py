# SPDX-License-Identifier: Apache-2.0
"""What a user may say about a graph that is to be started, on a command line or at a launch."""

import argparse
from collections.abc import Mapping
import os
from typing import TYPE_CHECKING

from srnn_bringup.arms import ARMS
from srnn_bringup.choices import FRI, SIMULATED, Choices
from srnn_bringup.environment import check_environment
from srnn_bringup.key_command import add_key
from srnn_bringup.options import (
    add_arm_description,
    add_keystore,
    add_learning,
    add_namespace,
    add_network,
    add_part,
    add_remappings,
    add_scene,
    add_seed,
    add_view,
    new_bag,
    new_file,
)

if TYPE_CHECKING:
    from srnn_bringup.config import Configuration


def add_graph(parser: argparse.ArgumentParser, arms: Mapping[str, str]) -> None:
    """Add what every command that starts the graph has."""
    meanings = ', '.join(f'{name} = {meaning}' for name, meaning in arms.items())
    parser.add_argument(
        '--arm', choices=tuple(arms), default=SIMULATED,
        help=f'arm to move: {meanings} (default: %(default)s)',
    )
    add_arm_description(parser)
    add_scene(parser)
    add_network(parser)
    add_learning(parser)
    add_seed(parser, 'seed of all random numbers')
    add_key(parser)
    add_keystore(parser)
    add_namespace(parser)
    parser.add_argument(
        '--record', type=new_bag, metavar='BAG',
        help='record every topic, and all that the run can be repeated from, to a new directory',
    )
    add_view(parser)
    parser.add_argument(
        '--save-weights', type=new_file, metavar='FILE',
        help='weights to write: at the end of a demo, and when asked by ~/save of the adapter',
    )  # fmt: skip


def add_up_options(parser: argparse.ArgumentParser) -> None:
    """Add what `srnn up` and the launch file have: the graph with any arm, or a part of it."""
    add_graph(parser, ARMS)
    add_part(parser)
    add_remappings(parser)
    parser.add_argument(
        '--emulator', action='store_true',
        help=f"for arm '{FRI}': emulate the controller, with the MuJoCo arm behind it",
    )


def configuration(options: argparse.Namespace) -> 'Configuration':
    """Return what the nodes are told, complete and checked.

    Raises:
        BringupError, ConfigError, SrnnError, AccessError: as `config.load`.

    """
    check_environment(os.environ)
    from srnn_bringup.config import load

    told = load(
        Choices(
            arm=options.arm,
            # A demo has an obstacle in the way: that of the simulator.
            emulated=options.arm == FRI if options.emulator is None else options.emulator,
            description=options.arm_description,
            scene=options.scene,
            network=options.network,
            signal=options.signal,
            alpha=options.alpha,
            seed=options.seed,
            initial_weights=options.weights,
            weights_file=options.save_weights,
            key_file=options.key,
            keystore=options.secure,
            namespace=options.namespace,
            remappings=getattr(options, 'remap', ()),
        )
    )
    if told.keystore is not None:
        from srnn_bringup.dds_security.enforcement import require_security

        require_security(told.keystore, os.environ)
    return told
