# SPDX-License-Identifier: Apache-2.0
"""What the live view costs, and whether any cycle of the arm is late for it.

Run: .venv/bin/python bench/live_view.py [--seconds S] [--out FILE]

The graph runs alone, with the view beside it, and with a browser that shows the page, in turn.
The browser is Chromium on this machine, which draws with the processor what a graphics card
draws elsewhere. The exit code is 1 if more cycles of the arm are late than without a view,
by more than three standard deviations of the difference of two counts.
"""

from math import sqrt
import os
from pathlib import Path
import sys
import tempfile

from beside import Stretch, arguments, running

from srnn_bringup.viewer import VIEW, viewing

sys.path.insert(0, str(Path(__file__).parents[1] / 'test'))
from browser import BROWSER, Browser

ROUNDS = 3
ALONE, VIEWED, SHOWN = 'alone', 'with a view', 'with a view in a browser'
SIZE = 1400, 900
PORT = 18080


def main() -> int:
    """Measure, and print or write the table."""
    choice = arguments(__doc__.splitlines()[0])
    lines = [
        '# What the live view costs', '',
        f'`bench/live_view.py --seconds {choice.seconds:g}`, {os.cpu_count()} processors: the '
        'default graph in real time, without a view,',
        'with one, and with a browser of this machine that shows it, in turn.', '',
        '| the graph | view takes | browser takes | cycles late |',
        '|---|---|---|---|',
    ]  # fmt: skip
    late = dict.fromkeys((ALONE, VIEWED, SHOWN), 0)

    def tell(name: str, stretch: Stretch) -> None:
        late[name] += stretch.late
        taken = [f'{share:.1%} of a core' for share in stretch.shares] + ['', '']
        row = (name, *taken[:2], str(stretch.late))
        lines.append(f'| {" | ".join(row)} |')
        print(lines[-1], flush=True)

    with running(choice.seconds) as (bench, configuration):
        for _ in range(ROUNDS):
            tell(ALONE, bench.run())
            with viewing(configuration, PORT, print) as pids:
                tell(VIEWED, bench.run(pids[VIEW]))
                if BROWSER is None:
                    continue
                with tempfile.TemporaryDirectory() as folder, Browser(Path(folder), *SIZE) as page:
                    page.open(f'http://127.0.0.1:{PORT}')
                    tell(SHOWN, bench.run(pids[VIEW], page.pid))
    if choice.out:
        choice.out.write_text('\n'.join(lines) + '\n', encoding='utf-8')
    return int(any(n - late[ALONE] > 3.0 * sqrt(n + late[ALONE]) for n in late.values()))


if __name__ == '__main__':
    raise SystemExit(main())
