# SPDX-License-Identifier: Apache-2.0
"""The transfer experiment for people (Markdown) and for spreadsheets (CSV)."""

from collections.abc import Mapping, Sequence
import csv
import io
from typing import Any

from srnn_experiments.estimates import mean_text, share_text
from srnn_experiments.figures import LATE
from srnn_experiments.paper import TRANSFER_CONTACTS, TRANSFER_FIRST_TOUCH
from srnn_experiments.transfer import Transfer
from srnn_experiments.transfer_report import MEDIAN_TARGET, OVERALL, SHARE_TARGET, SOUND, Row
from srnn_experiments.transfer_trial import SLACK, TargetTrial

_PAPER = (
    f'| paper, real arm, 1 trial | – | {TRANSFER_CONTACTS} | 0 | – | {TRANSFER_FIRST_TOUCH} '
    '| – | – |'
)

_CSV = (
    'row', 'start', 'seed', 'learned', 'contacts_new', 'contacts_old', 'contacts_nothing',
    'first_touch', 'updates', 'laps',
)  # fmt: skip


def as_markdown(
    transfers: Mapping[str, Transfer],
    rows: Mapping[str, Row],
    table: Mapping[str, Mapping[str, Any]],
    seeds: Sequence[int],
    picture: str,
) -> str:
    """Return the report; what comes before the first heading of level 2 is its summary."""
    return '\n'.join(
        [
            *_head(next(iter(transfers.values())), seeds),
            '',
            *_transferred(table),
            '',
            *_targets(table[OVERALL]),
            '',
            *_failures(rows),
            '',
            '## One trial',
            '',
            'The first in which the new obstacle was touched:',
            '',
            f'![Path of the tip until the last touch, and afterwards]({picture})',
            '',
            '## What the transfer is worth',
            '',
            'The same worlds and seeds, started from the prior weights instead:',
            '',
            *_scratch(table),
            '',
            '## Worlds',
            '',
            *_worlds(transfers, table),
            '',
            '## Definitions',
            '',
            *_definitions(),
            '',
        ]
    )


def as_csv(rows: Mapping[str, Row]) -> str:
    """Return a line for every trial in a target world, with and without transfer."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator='\n')
    writer.writerow(_CSV)
    for name, row in rows.items():
        for start, trials in (('transferred', row.transferred), ('scratch', row.scratch)):
            writer.writerows([name, start, *_values(trial)] for trial in trials)
    return text.getvalue()


def _values(trial: TargetTrial) -> list[object]:
    first = trial.new[0] if trial.new else ''
    return [
        trial.seed, int(trial.learned), len(trial.new), len(trial.old), len(trial.nothing),
        first, trial.updates, trial.laps,
    ]  # fmt: skip


def _head(transfer: Transfer, seeds: Sequence[int]) -> list[str]:
    source, target = transfer.source, transfer.target
    here, there = source.scene.task.name, target.scene.task.name
    return [
        f'# Transfer: {len(seeds)} trials of {target.segments} segments for each row',
        '',
        f'Phase 1 learns the scene `{here}` from the prior weights. Phase 2 starts from what '
        f'phase 1 of the same seed has learned, in another world and in the scene `{there}`, '
        f'where a new obstacle stands as well. Seeds {seeds[0]} to {seeds[-1]}, learning '
        f'signal {source.brain.model.learning.signal}. Learned: no contact in the last {LATE} '
        'segments, and every way point still reached in them.',
    ]


def _transferred(table: Mapping[str, Mapping[str, Any]]) -> list[str]:
    lines = [
        f'| row | learned with at most {TRANSFER_CONTACTS} contacts | contacts with the new '
        'obstacle | contacts with the first obstacle, all trials | trials without one '
        '| first touch of the new obstacle, segment | updates | laps |',
        '|---' * 8 + '|',
    ]
    for name, found in table.items():
        first = found['first_touch']
        cells = [
            share_text(found['few']), _range(found['new']), f'{found["old"]["total"]}',
            share_text(found['old_untouched']), _range(first) if first else 'never',
            mean_text(found['updates']), mean_text(found['laps']),
        ]  # fmt: skip
        lines.append(f'| {name} | {" | ".join(cells)} |')
    return [*lines, _PAPER]


def _targets(found: Mapping[str, Any]) -> list[str]:
    values = {
        'few': f'share of trials that learn with at most {TRANSFER_CONTACTS} contacts, at least '
        f'{SHARE_TARGET:.0%}: {share_text(found["few"])}',
        'median': f'median of contacts with the new obstacle, at most {MEDIAN_TARGET}: '
        f'{found["new"]["median"]:g}',
        'old': 'contacts with the first obstacle, none in any trial: '
        f'{found["old"]["total"]} in {found["trials"]} trials',
    }
    met = {True: 'met', False: 'missed'}
    return ['Targets, over all rows:', ''] + [
        f'* {text} ({met[found["targets"][key]]})' for key, text in values.items()
    ]


def _failures(rows: Mapping[str, Row]) -> list[str]:
    lines = []
    for name, row in rows.items():
        for trial, source_learned in zip(row.transferred, row.source_learned, strict=True):
            if trial.failures:
                also = '' if source_learned else '; nor had phase 1 learned'
                lines.append(f'* {name}, seed {trial.seed}: {"; ".join(trial.failures)}{also}')
    return ['Failures: none.'] if not lines else ['Failures:', '', *lines]


def _scratch(table: Mapping[str, Mapping[str, Any]]) -> list[str]:
    lines = [
        '| row | learned | contacts with the new obstacle | contacts with the first obstacle '
        '| laps | contacts spared by the transfer |',
        '|---' * 6 + '|',
    ]
    for name, found in table.items():
        start = found['scratch']
        cells = [
            share_text(start['learned']), _range(start['new']), _range(start['old']),
            mean_text(start['laps']), mean_text(found['spared']),
        ]  # fmt: skip
        lines.append(f'| {name} | {" | ".join(cells)} |')
    return lines


def _worlds(
    transfers: Mapping[str, Transfer], table: Mapping[str, Mapping[str, Any]]
) -> list[str]:
    return [
        f'* {name}: {transfer.change}. Phase 1 in {transfer.source.place}, learned: '
        f'{share_text(table[name]["source_learned"])}. Phase 2 in '
        f'{transfer.target.place}, contacts where no obstacle is: '
        f'{table[name]["nothing_touched"]}.'
        for name, transfer in transfers.items()
    ]


def _definitions() -> list[str]:
    return [
        '* Contacts are those of the whole trial: one that learned makes none afterwards, in one '
        'that failed there would be more.',
        '* A contact is a segment that the arm broke off. It was with the obstacle nearest to '
        f'the measured tip, if the tool was within {1e3 * SLACK:g} mm of it, else with nothing.',
        '* Numbers of contacts and segments: median (least to most). Shares: with 95 % interval '
        '(Wilson). Others: mean ± sd [95 % interval of the mean].',
        '* Spared: contacts of a trial from scratch less those of the transferred trial of the '
        'same seed.',
        f'* Rows `{OVERALL}` and `{SOUND}`: rows share seeds, and rows with the same source '
        'share phase 1, so that these intervals are somewhat too narrow. The second leaves out '
        'what starts from weights with which phase 1 had not learned its own scene.',
    ]


def _range(counts: Mapping[str, float]) -> str:
    return f'{counts["median"]:g} ({counts["min"]:g} to {counts["max"]:g})'
