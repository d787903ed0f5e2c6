# SPDX-License-Identifier: Apache-2.0
"""The `srnn` command."""

import argparse
from collections.abc import Sequence
import os
from pathlib import Path
import sys

from srnn_access import AccessError
from srnn_bag import BagError
from srnn_bench.errors import BenchError
from srnn_bringup.arms import ARMS
from srnn_bringup.belief_command import add_belief_actions
from srnn_bringup.bench_command import add_bench
from srnn_bringup.command_line import Parser
from srnn_bringup.completion_command import add_completion
from srnn_bringup.config import FRI, SIMULATED
from srnn_bringup.doctor_command import add_doctor
from srnn_bringup.environment import check_environment
from srnn_bringup.errors import BringupError
from srnn_bringup.examples import epilog
from srnn_bringup.exit_codes import FAILED, MEANINGS, WRONG_USE, by_signal
from srnn_bringup.experiment_options import add_experiments
from srnn_bringup.graph_options import add_graph, add_up, configuration
from srnn_bringup.key_command import add_key_actions
from srnn_bringup.keystore_command import add_keystore_actions
from srnn_bringup.options import (
    add_keystore,
    add_namespace,
    add_peers,
    new_bag,
    picture_file,
    whole,
)
from srnn_bringup.replay_command import add_replay
from srnn_bringup.report_command import add_report
from srnn_bringup.speech import speaking
from srnn_bringup.speech_options import add_json, add_quiet
from srnn_config import ConfigError
from srnn_experiments.errors import ExperimentError
from srnn_planner.core.errors import SrnnError

SEGMENTS = 150
"""About three minutes of the standard scene."""

SEGMENTS_MAX = 100_000

_MISTAKES = (
    AccessError, BagError, BenchError, BringupError, ConfigError, ExperimentError, SrnnError,
)  # fmt: skip

_ONLY_WORDS = ('belief list', 'belief diff', 'completion')
"""The commands that only say something: quiet, they would be of no use."""

_ENVIRONMENT = """\
The graph uses ROS_DOMAIN_ID as it finds it, and stays on this host unless other hosts
are named or ROS_AUTOMATIC_DISCOVERY_RANGE says otherwise. SRNN_REALTIME_PRIORITY sets the
priority of the nodes that move the arm, 0 for none.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code, see `srnn_bringup.exit_codes`."""
    parser, commands = parsers()
    options, unknown = parser.parse_known_args(arguments)
    chosen = (options.command, getattr(options, 'action', None))
    commands.get(' '.join(filter(None, chosen)), parser).refuse_unknown(unknown)
    quiet, document = getattr(options, 'quiet', False), getattr(options, 'json', None)
    try:
        with speaking(quiet, document):
            code = int(options.run(options))
            sys.stdout.flush()
            return code
    except _MISTAKES as error:
        print(f'srnn {options.command}: {error}', file=sys.stderr)
        return WRONG_USE
    except BrokenPipeError:
        # Whoever read the output has had enough; the interpreter flushes it once more at its end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return by_signal('SIGPIPE')
    except OSError as error:
        print(f'srnn {options.command}: {error}', file=sys.stderr)
        return FAILED
    except KeyboardInterrupt:
        return by_signal('SIGINT')


def parsers() -> tuple[Parser, dict[str, Parser]]:
    """Return the parser of the command line, and those of all commands by name."""
    parser = Parser(
        prog='srnn',
        description='An arm that plans while it moves, and learns by touch.',
    )
    table = parser.add_subparsers(dest='command', metavar='COMMAND', required=True)
    commands: dict[str, Parser] = {
        name: table.add_parser(
            name, help=text, description=text, epilog=_ENVIRONMENT
        )
        for name, text in (
            ('demo', 'Learn an obstacle live on the simulated arm, and report.'),
            ('up', 'Start the graph and keep it up until Ctrl-C.'),
            ('pause', 'Bring the arm of a running graph to rest, and have it stay there.'),
            ('resume', 'Have a paused graph go on.'),
            ('record', 'Record what a running graph says, until Ctrl-C.'),
            ('replay', 'Decide again what a recorded run has decided, and compare bit for bit.'),
            ('report', 'A recorded run, or the results of an experiment, as one web page.'),
            ('belief', 'What a run has learned: look at it, undo it, put it together.'),
            ('doctor', 'Find what is wrong with this machine, and say what to do about it.'),
            ('key', 'Make the key by which the nodes know each other.'),
            ('keystore', 'Keys and permissions of the graph, for a middleware with DDS security.'),
            ('experiment', 'Many trials on simulated time: runs and tables.'),
            ('bench', 'The planner beside other simulators and planners, timed in turn.'),
            ('completion', 'The script by which a shell completes commands and options.'),
        )
    }  # fmt: skip
    _add_demo(commands['demo'])
    add_up(commands['up'])
    commands['up'].set_defaults(run=_up)
    for name, run in (('pause', _pause), ('resume', _resume)):
        commands[name].set_defaults(run=run)
    commands['record'].add_argument(
        'bag', type=new_bag, metavar='BAG', help='new directory to record to'
    )
    commands['record'].set_defaults(run=_record)
    add_replay(commands['replay'])
    add_report(commands['report'])
    add_bench(commands['bench'])
    for name in ('up', 'pause', 'resume', 'record'):
        add_peers(commands[name])
    for name in ('pause', 'resume', 'record'):
        add_keystore(commands[name])
        add_namespace(commands[name])
    add_doctor(commands['doctor'])
    add_completion(commands['completion'], parser)
    for command, metavar, add in (
        ('experiment', 'EXPERIMENT', add_experiments),
        ('belief', 'ACTION', add_belief_actions),
        ('key', 'ACTION', add_key_actions),
        ('keystore', 'ACTION', add_keystore_actions),
    ):
        actions = commands[command].add_subparsers(
            dest='action', metavar=metavar, required=True, parser_class=Parser
        )
        for name, action in add(actions).items():
            commands[f'{command} {name}'] = action
    for name, command_parser in {'': parser, **commands}.items():
        if not command_parser.has_actions and name not in _ONLY_WORDS:
            add_quiet(command_parser)
        remarks = (command_parser.epilog or '', MEANINGS)
        command_parser.epilog = epilog(name, *filter(None, remarks))
        command_parser.formatter_class = argparse.RawDescriptionHelpFormatter
    return parser, commands


def _add_demo(parser: Parser) -> None:
    add_graph(
        parser,
        {SIMULATED: ARMS[SIMULATED], FRI: 'the same behind FRI and an emulated controller'},
    )
    parser.add_argument(
        '--segments', type=whole(1, SEGMENTS_MAX), default=SEGMENTS, metavar='N',
        help='segments to execute (default: %(default)s, about three minutes)',
    )
    add_json(parser)
    parser.add_argument(
        '--picture', type=picture_file, default=Path('demo.png'), metavar='FILE',
        help='picture to write (default: %(default)s)',
    )  # fmt: skip
    parser.set_defaults(run=_demo, emulator=None)


def _demo(options: argparse.Namespace) -> int:
    told = configuration(options)
    from srnn_bringup.demo import run_demo
    from srnn_bringup.report import Outputs

    outputs = Outputs(options.picture, options.json, options.save_weights)
    return run_demo(told, options.segments, outputs, options.record, options.view)


def _up(options: argparse.Namespace) -> int:
    told = configuration(options)
    from srnn_bringup.up import run_up

    return run_up(told, options.only, options.peer, options.record, options.view)


def _pause(options: argparse.Namespace) -> int:
    check_environment(os.environ)
    from srnn_bringup.pausing import run_pause

    return run_pause(options.peer, options.secure, options.namespace)


def _resume(options: argparse.Namespace) -> int:
    check_environment(os.environ)
    from srnn_bringup.pausing import run_resume

    return run_resume(options.peer, options.secure, options.namespace)


def _record(options: argparse.Namespace) -> int:
    check_environment(os.environ)
    from srnn_bringup.record import run_record

    return run_record(options.bag, options.peer, options.secure, options.namespace)


if __name__ == '__main__':
    raise SystemExit(main())
