# SPDX-License-Identifier: Apache-2.0
"""Measures everything that docs/performance.md tells, and writes it anew.

Run: .venv/bin/python bench/performance.py [--only PART,...]

Nothing else should run meanwhile. Parts that are left out stay as they are.
"""

import argparse
from dataclasses import dataclass
from pathlib import Path
import re
import subprocess
import sys
import tempfile

DOCS = Path(__file__).parents[1] / 'docs'
PAGE = DOCS / 'performance.md'
HERE = Path(__file__).parent
MARK = '<!-- {}: {} -->'
"""A table begins and ends with a line like this."""


@dataclass(frozen=True)
class Part:
    """A table of the page, and the command that writes it."""

    name: str
    command: tuple[str, ...]


PARTS = (
    Part(
        'planning',
        (
            str(HERE / 'kernels.py'), '--repeats', '1000',
            '--picture', str(DOCS / 'performance.png'),
        ),
    ),
    Part('planning-30', (str(HERE / 'kernels.py'), '--repeats', '1000', '--steps', '30')),
    Part('scale', (str(HERE / 'scale.py'), '--picture', str(DOCS / 'scale.png'))),
    Part('latency', (str(HERE / 'latency.py'), '--runs', '5', '--segments', '8')),
    Part('peers', ('-m', 'srnn_bringup.cli', 'bench')),
)


def replaced(page: str, name: str, table: str) -> str:
    """Return the page with another table.

    Raises:
        ValueError: the page has no place for a table of this name.

    """
    begin, end = MARK.format(name, 'begin'), MARK.format(name, 'end')
    pattern = re.compile(f'{re.escape(begin)}\n.*?{re.escape(end)}', re.DOTALL)
    if not pattern.search(page):
        raise ValueError(f'{PAGE}: has no lines {begin} and {end}')
    # Headings of a table are below those of the page.
    lower = re.sub('^(?=#)', '##', table.strip(), flags=re.MULTILINE)
    return pattern.sub(lambda _: f'{begin}\n{lower}\n{end}', page)


def main() -> int:
    """Measure, and write the page."""
    names = [part.name for part in PARTS]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--only', metavar='PART,...', help=f'some of {", ".join(names)}')
    options = parser.parse_args()
    wanted = options.only.split(',') if options.only else names
    unknown = sorted(set(wanted) - set(names))
    if unknown:
        parser.error(f'--only {",".join(unknown)}: must be some of {", ".join(names)}')
    with tempfile.TemporaryDirectory() as directory:
        for part in (part for part in PARTS if part.name in wanted):
            table = Path(directory, part.name)
            # A bench that misses its bound says so by its exit code; its table is written.
            subprocess.run([sys.executable, *part.command, '--out', str(table)], check=False)
            page = PAGE.read_text(encoding='utf-8')
            PAGE.write_text(
                replaced(page, part.name, table.read_text(encoding='utf-8')), encoding='utf-8'
            )
    return 0


if __name__ == '__main__':
    raise SystemExit(main())
