# SPDX-License-Identifier: Apache-2.0
"""The `srnn` command."""

import argparse
from collections.abc import Sequence
import difflib
import os
from pathlib import Path
import sys
from typing import NoReturn

from srnn_bringup.config import SEED_MAX, STANDARD_SCENE, Choices, Configuration, load
from srnn_bringup.environment import check_environment
from srnn_bringup.errors import BringupError
from srnn_bringup.options import existing_file, new_file, picture_file, rate, whole
from srnn_config import ConfigError
from srnn_planner.core.dissonance import SIGNALS
from srnn_planner.core.errors import SrnnError

SEGMENTS = 150
"""About two minutes of the standard scene."""

SEGMENTS_MAX = 100_000
WRONG_USE = 2

_ENVIRONMENT = """\
The graph uses ROS_DOMAIN_ID as it finds it, and stays on this host unless
ROS_AUTOMATIC_DISCOVERY_RANGE says otherwise. SRNN_REALTIME_PRIORITY sets the priority of
the nodes that move the arm, 0 for none.
"""


class Parser(argparse.ArgumentParser):
    """Says in one line what is wrong with a command line."""

    def error(self, message: str) -> NoReturn:
        """Name the mistake and end with exit code 2."""
        self.exit(WRONG_USE, f'{self.prog}: {message}; see {self.prog} --help\n')

    def refuse_unknown(self, arguments: Sequence[str]) -> None:
        """Name the first argument that nobody knows, with the options there are."""
        if not arguments:
            return
        options = sorted(o for o in self._option_string_actions if o.startswith('--'))
        near = difflib.get_close_matches(arguments[0].partition('=')[0], options, n=1)
        hint = f" (did you mean '{near[0]}'?)" if near else ''
        self.error(f"unknown argument '{arguments[0]}'{hint}; options: {', '.join(options)}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code: 2 for a wrong command line or file."""
    parser, commands = _parsers()
    options, unknown = parser.parse_known_args(arguments)
    commands.get(options.command, parser).refuse_unknown(unknown)
    try:
        return int(options.run(options))
    except (BringupError, ConfigError, SrnnError) as error:
        print(f'srnn {options.command}: {error}', file=sys.stderr)
        return WRONG_USE
    except OSError as error:
        print(f'srnn {options.command}: {error}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


def _parsers() -> tuple[Parser, dict[str, Parser]]:
    parser = Parser(
        prog='srnn',
        description='An arm that plans while it moves, and learns by touch.',
        allow_abbrev=False,
    )
    table = parser.add_subparsers(dest='command', metavar='COMMAND', required=True)
    commands: dict[str, Parser] = {
        name: table.add_parser(
            name, help=text, description=text, allow_abbrev=False,
            epilog=_ENVIRONMENT, formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        for name, text in (
            ('demo', 'Learn an obstacle live on the simulated arm, and report.'),
            ('up', 'Start the graph and keep it up until Ctrl-C.'),
            ('doctor', 'Say what is installed, what is missing, and what rights there are.'),
        )
    }  # fmt: skip
    _add_demo(commands['demo'])
    _add_graph(commands['up'])
    commands['up'].set_defaults(run=_up)
    commands['doctor'].set_defaults(run=_doctor)
    return parser, commands


def _add_graph(parser: Parser) -> None:
    """Add what every command that starts the graph has."""
    parser.add_argument(
        '--arm', choices=('sim',), default='sim', help='arm to move (default: %(default)s)'
    )
    parser.add_argument(
        '--scene', default=STANDARD_SCENE, metavar='SCENE',
        help='name of a scene in config/scenes, or path of a scene file (default: %(default)s)',
    )
    parser.add_argument(
        '--signal', choices=tuple(SIGNALS), help='learning signal (default: as network.yaml says)'
    )
    parser.add_argument(
        '--alpha', type=rate, metavar='A', help='rate of the signals constant and untriggered'
    )
    parser.add_argument(
        '--seed', type=whole(0, SEED_MAX), default=0, metavar='S',
        help='seed of all random numbers (default: %(default)s)',
    )
    parser.add_argument(
        '--weights', type=existing_file, metavar='FILE', help='weights to start from'
    )
    parser.add_argument(
        '--save-weights', type=new_file, metavar='FILE',
        help='weights to write: at the end of a demo, and when asked by ~/save of the adapter',
    )  # fmt: skip


def _add_demo(parser: Parser) -> None:
    _add_graph(parser)
    parser.add_argument(
        '--segments', type=whole(1, SEGMENTS_MAX), default=SEGMENTS, metavar='N',
        help='segments to execute (default: %(default)s, about two minutes)',
    )
    parser.add_argument('--json', type=new_file, metavar='FILE', help='figures to write')
    parser.add_argument(
        '--picture', type=picture_file, default=Path('demo.png'), metavar='FILE',
        help='picture to write (default: %(default)s)',
    )  # fmt: skip
    parser.set_defaults(run=_demo)


def _configuration(options: argparse.Namespace) -> Configuration:
    check_environment(os.environ)
    return load(
        Choices(
            scene=options.scene,
            signal=options.signal,
            alpha=options.alpha,
            seed=options.seed,
            initial_weights=options.weights,
            weights_file=options.save_weights,
        )
    )


def _demo(options: argparse.Namespace) -> int:
    configuration = _configuration(options)
    from srnn_bringup.demo import run_demo
    from srnn_bringup.report import Outputs

    outputs = Outputs(options.picture, options.json, options.save_weights)
    return run_demo(configuration, options.segments, outputs)


def _up(options: argparse.Namespace) -> int:
    configuration = _configuration(options)
    from srnn_bringup.up import run_up

    return run_up(configuration)


def _doctor(_: argparse.Namespace) -> int:
    from srnn_bringup.doctor import run_doctor

    return run_doctor(print)


if __name__ == '__main__':
    raise SystemExit(main())
