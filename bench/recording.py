# SPDX-License-Identifier: Apache-2.0
"""What recording costs, and whether anything is lost or late for it.

Run: .venv/bin/python bench/recording.py [--seconds S] [--out FILE]

The graph runs without and with a recorder, in turn. The exit code is 1 if the recorder takes
more than 5 % of a core, or a message is lost, or more cycles of the arm are late than without it.
"""

import os
from pathlib import Path
import signal
import subprocess
import sys
import tempfile

from beside import Bench, Stretch, arguments, running

from srnn_bag import open_bag

SHARE = 0.05
ROUNDS = 3


def recorded(bench: Bench, directory: Path) -> tuple[Stretch, str]:
    """Run with a recorder beside the graph; return also what it has lost, in words."""
    command = [sys.executable, '-m', 'srnn_bringup.cli', 'record', str(directory)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        stretch = bench.run(process.pid)
        process.send_signal(signal.SIGINT)
        text = process.communicate()[0]
    lost = text.partition(str(directory))[2].partition(str(directory))[2].strip(' ,\n')
    return stretch, lost


def main() -> int:
    """Measure, and print or write the table."""
    choice = arguments(__doc__.splitlines()[0])
    lines = [
        '# What recording costs', '',
        f'`bench/recording.py --seconds {choice.seconds:g}`, {os.cpu_count()} processors: the '
        'default graph in real time, without and with',
        '`srnn record` beside it, in turn.', '',
        '| recorder | processor | cycles late | messages | size | lost |',
        '|---|---|---|---|---|---|',
    ]  # fmt: skip
    kept, late = True, {False: 0, True: 0}

    def tell(recording: bool, stretch: Stretch, *cells: str) -> None:
        late[recording] += stretch.late
        share = f'{stretch.shares[0]:.1%} of a core' if recording else ''
        row = ('yes' if recording else 'no', share, str(stretch.late), *cells)
        lines.append(f'| {" | ".join(row)} |')
        print(lines[-1], flush=True)

    with tempfile.TemporaryDirectory() as folder, running(choice.seconds) as (bench, _):
        for n in range(ROUNDS):
            tell(False, bench.run(), '', '', '')
            directory = Path(folder, f'bag{n}')
            stretch, lost = recorded(bench, directory)
            messages = sum(1 for _ in open_bag(directory).messages())
            size = sum(file.stat().st_size for file in directory.iterdir()) / 1e6
            tell(True, stretch, str(messages), f'{size:.1f} MB', lost or 'none')
            kept &= stretch.shares[0] <= SHARE and not lost
    kept &= late[True] <= max(late[False], 1)
    if choice.out:
        choice.out.write_text('\n'.join(lines) + '\n', encoding='utf-8')
    return 0 if kept else 1


if __name__ == '__main__':
    raise SystemExit(main())
