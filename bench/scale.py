# SPDX-License-Identifier: Apache-2.0
"""How time and memory of planning and learning grow with neurons, samples and replays.

Run: .venv/bin/python bench/scale.py [--repeats N] [--limit GIB] [--json FILE] [--out FILE]
                                     [--picture FILE]

Every case runs in a process of its own. The exit code is 1 if a goal is missed.
"""

import argparse
from collections.abc import Iterable
from dataclasses import asdict
import json
from pathlib import Path
import sys

from scale_picture import draw
from scale_run import Measured, measure
from scale_setting import Case
from scale_table import Found, goals, table

SIDES = {2: (15, 21, 31, 45, 61, 81, 101), 3: (7, 11, 15, 21, 31)}
SAMPLES = (40, 100, 200, 400, 1000)
REPLAYS = (20, 50, 100, 200)
SIDE = 15
"""Neurons a side where samples or replays grow."""


def measured(cases: Iterable[Case], repeats: int, limit_gib: float) -> list[Measured]:
    """Measure cases one after the other."""
    found = []
    for case in cases:
        print(case, file=sys.stderr)
        found.append(measure(case, repeats, limit_gib))
    return found


def main() -> int:
    """Measure, and print or write table, figures and picture."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--repeats', type=int, default=100, help='timed calls (default 100)')
    parser.add_argument(
        '--limit', type=float, default=6.0, metavar='GIB',
        help='memory that a process may have, default: 6',
    )  # fmt: skip
    parser.add_argument('--json', type=Path, metavar='FILE', help='where all figures are written')
    parser.add_argument('--out', type=Path, metavar='FILE', help='where the table is written')
    parser.add_argument('--picture', type=Path, metavar='FILE', help='where it is drawn')
    choice = parser.parse_args()
    # Whoever comes first compiles; it shall not be one that counts.
    measure(Case(2, SIDE), 1, choice.limit)

    def of(cases: Iterable[Case]) -> list[Measured]:
        return measured(cases, choice.repeats, choice.limit)

    found = Found(
        {d: of(Case(d, side) for side in sides) for d, sides in SIDES.items()},
        of(Case(2, SIDE, samples=samples) for samples in SAMPLES),
        of(Case(2, SIDE, replays=replays) for replays in REPLAYS),
        choice.limit,
    )
    text = table(found)
    print(text)
    if choice.out:
        choice.out.write_text(text + '\n', encoding='utf-8')
    if choice.json:
        choice.json.write_text(json.dumps(asdict(found), indent=1) + '\n', encoding='utf-8')
    if choice.picture:
        draw(found, choice.picture)
    return int(any(goal.missed for goal in goals(found)))


if __name__ == '__main__':
    raise SystemExit(main())
