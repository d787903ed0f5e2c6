# SPDX-License-Identifier: Apache-2.0
"""`srnn belief`: what a run has learned, version by version; undone, and put together."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from srnn_bringup.errors import ChoiceError
from srnn_bringup.exit_codes import DONE
from srnn_bringup.options import new_file, picture_file
from srnn_bringup.speech import write_document
from srnn_bringup.speech_options import add_json
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core import belief, weights_file
from srnn_planner.core.synapses import Synapses
from srnn_planner.core.synaptic_change import input_change, output_change

if TYPE_CHECKING:
    from srnn_bringup.belief_source import Belief, Version
    from srnn_bringup.command_line import Parser

SOURCE = 'bag or weight file; @N behind a bag for version N (default: the newest)'
HEADING = ('version', 'after', 'synapses', 'largest', 'where [m]')


def add_belief_actions(table: 'argparse._SubParsersAction[Parser]') -> 'dict[str, Parser]':
    """Add the actions to the sub-parsers `table`; return their parsers by name."""
    actions: dict[str, Parser] = {}

    def add(name: str, text: str, run: Callable[[argparse.Namespace], int]) -> 'Parser':
        actions[name] = table.add_parser(name, help=text, description=text, allow_abbrev=False)
        actions[name].set_defaults(run=run)
        return actions[name]

    parser = add('list', 'Every version in a bag, and what it has changed.', _list)
    parser.add_argument('source', metavar='SOURCE', help=SOURCE)
    add_json(parser, 'the same')
    parser = add('show', 'Draw what was learned since the prior.', _show)
    parser.add_argument('source', metavar='SOURCE', help=SOURCE)
    parser.add_argument('picture', type=picture_file, metavar='PICTURE', help='file to write')
    parser = add('diff', 'Tell how one version differs from another.', _diff)
    parser.add_argument('one', metavar='SOURCE', help=SOURCE)
    parser.add_argument('other', metavar='OTHER', help=SOURCE)
    parser.add_argument('--picture', type=picture_file, metavar='FILE', help='file to write')
    add_json(parser, 'the same')
    parser = add('revert', 'Undo one update; what came later stays.', _revert)
    parser.add_argument('source', metavar='BAG@N', help='the update that led to version N')
    parser.add_argument('weights', type=new_file, metavar='FILE', help='weights to write')
    parser = add('merge', 'Put together what two runs have learned.', _merge)
    parser.add_argument('one', metavar='SOURCE', help=SOURCE)
    parser.add_argument('other', metavar='OTHER', help=SOURCE)
    parser.add_argument('weights', type=new_file, metavar='FILE', help='weights to write')
    return actions


def _list(options: argparse.Namespace) -> int:
    from srnn_bringup.belief_source import read

    source, _ = read(options.source)
    began = source.versions[0].shared_ns
    print(_row(HEADING))
    rows = []
    for version in source.versions:
        before = source.synapses(source.before(version))
        found = belief.change(before, source.synapses(version))
        after_s = 1e-9 * (version.shared_ns - began) if version.shared_ns else None
        after = '-' if after_s is None else f'{after_s:.1f} s'
        print(_row((str(version.weights.version), after, *_words(source, found))))
        number = int(version.weights.version)
        rows.append({'version': number, 'after_s': after_s, **_figures(source, found)})
    if options.json is not None:
        write_document(options.json, {'versions': rows})
    return DONE


def _show(options: argparse.Namespace) -> int:
    from srnn_bringup.belief_source import read

    source, version = read(options.source)
    title = f'version {version.weights.version} against the prior'
    _draw(source, source.prior, version, title, options.picture)
    return DONE


def _diff(options: argparse.Namespace) -> int:
    from srnn_bringup.belief_source import read

    (source, one), (_, other) = read(options.one), read(options.other)
    found = belief.change(source.synapses(one), source.synapses(other))
    print(_row(HEADING[2:]))
    print(_row(_words(source, found)))
    if options.json is not None:
        write_document(options.json, _figures(source, found))
    if options.picture is not None:
        _draw(source, one, other, f'{options.other} against {options.one}', options.picture)
    return DONE


def _revert(options: argparse.Namespace) -> int:
    from srnn_bringup.belief_source import AT, read

    source, version = read(options.source)
    if AT not in options.source or len(source.versions) < 2:
        raise ChoiceError(f'{options.source}: name the update to undo as BAG{AT}N')
    newest = source.versions[-1]
    versions = newest, source.before(version), version
    synapses = belief.undone(*map(source.synapses, versions))
    _save(options.weights, newest.weights.version + 1, synapses)
    return DONE


def _merge(options: argparse.Namespace) -> int:
    from srnn_bringup.belief_source import read

    (source, one), (_, other) = read(options.one), read(options.other)
    synapses = belief.merged(source.synapses(one), source.synapses(other))
    _save(options.weights, max(one.weights.version, other.weights.version) + 1, synapses)
    return DONE


def _save(path: Path, version: int, synapses: Synapses) -> None:
    weights_file.save(path, WeightsUpdate(version, 0, synapses.learned))
    print(f'{path}: version {version}; start with `srnn up --weights {path}`')


def _draw(source: 'Belief', before: 'Version', after: 'Version', title: str, path: Path) -> None:
    from matplotlib.figure import Figure

    from srnn_bringup.plots.plane import draw_change
    from srnn_bringup.plots.style import DPI, styled

    change = source.synapses(after), source.synapses(before)
    with styled():
        figure = Figure(figsize=(6.4, 5.4), dpi=DPI, layout='constrained')
        axes = figure.add_subplot()
        image = draw_change(
            axes, source.metres, input_change(*change), output_change(*change)
        )
        figure.colorbar(image, ax=axes, label='average change of synaptic input')
        axes.set_title(title, fontsize=11)
        axes.set_aspect('equal')
        figure.savefig(path)
    print(f'picture: {path}')


def _figures(source: 'Belief', found: belief.Change) -> dict[str, Any]:
    """Return a change as plain data for JSON; the place [m] is None where nothing changed."""
    metres = source.model.workspace.to_metres(found.centre)
    return {
        'synapses': int(found.synapses),
        'largest': float(found.largest),
        'where_m': [float(x) for x in metres] if found.synapses else None,
    }


def _words(source: 'Belief', found: belief.Change) -> tuple[str, str, str]:
    metres = source.model.workspace.to_metres(found.centre)
    where = ', '.join(f'{x:.3f}' for x in metres) if found.synapses else '-'
    return str(found.synapses), f'{found.largest:+.3f}', where


def _row(cells: tuple[str, ...]) -> str:
    return '  '.join(cell.rjust(9) for cell in cells)
