# SPDX-License-Identifier: Apache-2.0
"""The `srnn` command."""

import argparse
from collections.abc import Mapping, Sequence
from functools import partial
from importlib import import_module
import os
import sys

from srnn_bringup.command_line import Parser
from srnn_bringup.examples import epilog
from srnn_bringup.exit_codes import FAILED, MEANINGS, WRONG_USE, by_signal
from srnn_bringup.speech import speaking

_COMMANDS: Mapping[str, tuple[str, str]] = {
    'demo': ('demo_command:add_demo', 'Learn an obstacle live on the simulated arm, and report.'),
    'up': ('up_command:add_up', 'Start the graph and keep it up until Ctrl-C.'),
    'pause': (
        'pause_command:add_pause',
        'Bring the arm of a running graph to rest, and have it stay there.',
    ),
    'resume': ('pause_command:add_resume', 'Have a paused graph go on.'),
    'record': ('record_command:add_record', 'Record what a running graph says, until Ctrl-C.'),
    'replay': (
        'replay_command:add_replay',
        'Decide again what a recorded run has decided, and compare bit for bit.',
    ),
    'report': (
        'report_command:add_report',
        'A recorded run, or the results of an experiment, as one web page.',
    ),
    'belief': (
        'belief_command:add_belief_actions',
        'What a run has learned: look at it, undo it, put it together.',
    ),
    'doctor': (
        'doctor_command:add_doctor',
        'Find what is wrong with this machine, and say what to do about it.',
    ),
    'key': ('key_command:add_key_actions', 'Make the key by which the nodes know each other.'),
    'keystore': (
        'dds_security.command:add_keystore_actions',
        'Keys and permissions of the graph, for a middleware with DDS security.',
    ),
    'experiment': (
        'experiments.command:add_experiments', 'Many trials on simulated time: runs and tables.'
    ),
    'bench': (
        'bench_command:add_bench',
        'The planner beside other simulators and planners, timed in turn.',
    ),
    'completion': (
        'completion_command:add_completion',
        'The script by which a shell completes commands and options.',
    ),
}
"""By name of a command: the module and the function that add its options, and what it does.

Each is imported when its command is asked for: help is there at once, and `srnn doctor` where
something is missing.
"""

_ACTIONS = {
    'experiment': 'EXPERIMENT', 'belief': 'ACTION', 'key': 'ACTION', 'keystore': 'ACTION'
}  # fmt: skip
"""The commands behind which another one follows, and what the usage calls that."""

_MISTAKES: Mapping[str, str] = {
    'srnn_access.errors': 'AccessError',
    'srnn_bag.errors': 'BagError',
    'srnn_bench.errors': 'BenchError',
    'srnn_bringup.errors': 'BringupError',
    'srnn_config.errors': 'ConfigError',
    'srnn_experiments.errors': 'ExperimentError',
    'srnn_planner.core.errors': 'SrnnError',
    'srnn_replay.errors': 'ReplayError',
}
"""By module, the errors whose text is one line for the user."""

_ONLY_WORDS = ('belief list', 'belief diff', 'completion')
"""The commands that only say something: quiet, they would be of no use."""

_ENVIRONMENT = """\
The graph uses ROS_DOMAIN_ID as it finds it, and stays on this host unless other hosts
are named or ROS_AUTOMATIC_DISCOVERY_RANGE says otherwise. SRNN_REALTIME_PRIORITY sets the
priority of the nodes that move the arm, 0 for none.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code, see `srnn_bringup.exit_codes`."""
    parser, commands = _outline()
    name = parser.prog
    try:
        options, unknown = parser.parse_known_args(arguments)
        chosen = (options.command, getattr(options, 'action', None))
        commands.get(' '.join(filter(None, chosen)), parser).refuse_unknown(unknown)
        name = f'{parser.prog} {options.command}'
        quiet, document = getattr(options, 'quiet', False), getattr(options, 'json', None)
        with speaking(quiet, document):
            code = int(options.run(options))
            sys.stdout.flush()
            return code
    except _mistakes() as error:
        print(f'{name}: {error}', file=sys.stderr)
        return WRONG_USE
    except ImportError as error:
        print(f'{name}: {error}; `srnn doctor` says what is missing', file=sys.stderr)
        return FAILED
    except BrokenPipeError:
        # Whoever read the output has had enough; the interpreter flushes it once more at its end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return by_signal('SIGPIPE')
    except OSError as error:
        print(f'{name}: {error}', file=sys.stderr)
        return FAILED
    except KeyboardInterrupt:
        return by_signal('SIGINT')


def _mistakes() -> tuple[type[Exception], ...]:
    """Return the errors of `_MISTAKES`; what was not imported has raised none."""
    loaded = {module: name for module, name in _MISTAKES.items() if module in sys.modules}
    return tuple(getattr(sys.modules[module], name) for module, name in loaded.items())


def parsers() -> tuple[Parser, dict[str, Parser]]:
    """Return the parser of the command line, and those of all commands by name."""
    parser, commands = _outline()
    for name in _COMMANDS:
        commands[name].fill()
    return parser, commands


def _outline() -> tuple[Parser, dict[str, Parser]]:
    """Return the parser of the command line, and those of commands, which fill themselves."""
    parser = Parser(
        prog='srnn',
        description='An arm that plans while it moves, and learns by touch.',
    )
    table = parser.add_subparsers(dest='command', metavar='COMMAND', required=True)
    commands: dict[str, Parser] = {
        name: table.add_parser(name, help=text, description=text, epilog=_ENVIRONMENT)
        for name, (_, text) in _COMMANDS.items()
    }
    for name, command in commands.items():
        command.fill_by(partial(_fill, name, parser, commands))
    _finish('', parser)
    return parser, commands


def _fill(name: str, root: Parser, commands: dict[str, Parser]) -> None:
    """Add the options of a command, and the actions that it has to `commands`."""
    parser = commands[name]
    module, _, function = _COMMANDS[name][0].partition(':')
    add = getattr(import_module(f'srnn_bringup.{module}'), function)
    if name in _ACTIONS:
        actions = parser.add_subparsers(
            dest='action', metavar=_ACTIONS[name], required=True, parser_class=Parser
        )
        for action, action_parser in add(actions).items():
            commands[f'{name} {action}'] = action_parser
            _finish(f'{name} {action}', action_parser)
    elif name == 'completion':
        for command in list(commands.values()):
            command.fill()
        add(parser, root)
    else:
        add(parser)
    _finish(name, parser)


def _finish(name: str, parser: Parser) -> None:
    """Add what every command has."""
    if not parser.has_actions and name not in _ONLY_WORDS:
        from srnn_bringup.speech_options import add_quiet

        add_quiet(parser)
    parser.epilog = epilog(name, *filter(None, (parser.epilog or '', MEANINGS)))
    parser.formatter_class = argparse.RawDescriptionHelpFormatter


if __name__ == '__main__':
    raise SystemExit(main())
