# SPDX-License-Identifier: Apache-2.0
"""What happens, in words, one line at a time."""

from typing import TextIO

from srnn_experiments.segment_record import SegmentRecord
from srnn_msgs_py.result import ResultCode, SegmentResult

COLUMNS = ('segment', 'way point', 'planned', 'length', 'time', 'result', 'dissonance', 'updates')
WIDTHS = (7, 9, 8, 7, 6, 8, 10, 7)
MARGIN = ' ' * 9
"""Events stand under the first column."""

_RESULTS = {
    ResultCode.DONE: 'done',
    ResultCode.BLOCKED: 'touched',
    ResultCode.FAULT: 'fault',
}
_DIM, _YELLOW, _GREEN, _RED = '2', '33', '32', '31'


class Console:
    """Prints segments and events; in colour on a terminal only."""

    def __init__(self, out: TextIO) -> None:
        """Print to `out`."""
        self._out = out
        self._colour = out.isatty()
        self._touches = 0
        self._updates = 0

    def note(self, text: str) -> None:
        """Print what the command itself does."""
        self._print(text, _DIM)

    def heading(self) -> None:
        """Print the names of the columns."""
        self._print(_row(COLUMNS), _DIM)

    def segment(self, record: SegmentRecord) -> None:
        """Print one segment and the events that came with it."""
        self._updates += record.updated
        lesson = record.lesson
        cells = (
            str(record.number),
            str(record.before.active + 1),
            '-' if record.planning_ms is None else f'{record.planning_ms:.1f} ms',
            f'{1e3 * record.length:.0f} mm',
            f'{record.plan.duration:.2f} s',
            _RESULTS[record.result.code],
            '-' if lesson is None else f'{lesson.peak:.3f}',
            str(self._updates),
        )
        self._print(_row(cells))
        if record.touched:
            self._touches += 1
            self._event(self._touch(record), _YELLOW)
        elif record.result.code is ResultCode.FAULT:
            self._event(f'fault: {record.result.reason}', _RED)
        elif lesson is not None and lesson.updated:
            self._event(f'learned, weights version {lesson.weights_version}', _YELLOW)
        if record.reached:
            self._event(f'way point {record.before.active + 1} reached', _GREEN)
        if record.after.laps > record.before.laps:
            self._event(f'lap {record.after.laps}', _GREEN)

    def refused(self, result: SegmentResult) -> None:
        """Print that the tracker would not execute a segment."""
        self._event(f'segment not executed: {result.reason}', _YELLOW)

    def _touch(self, record: SegmentRecord) -> str:
        x, y = record.executed.positions[-1, :2]
        force = record.result.values.get('force_n', 0.0)
        lesson = record.lesson
        if lesson is None:
            learned = 'nothing heard of the adapter'
        elif lesson.updated:
            learned = f'learned, weights version {lesson.weights_version}'
        else:
            learned = 'nothing learned'
        return f'touch {self._touches}: {force:.0f} N at ({x:.2f}, {y:.2f}); {learned}'

    def _event(self, text: str, colour: str) -> None:
        self._print(MARGIN + text, colour)

    def _print(self, text: str, colour: str = '') -> None:
        if self._colour and colour:
            text = f'\033[{colour}m{text}\033[0m'
        print(text, file=self._out, flush=True)


def _row(cells: tuple[str, ...]) -> str:
    return '  '.join(cell.rjust(width) for cell, width in zip(cells, WIDTHS, strict=True))
