# SPDX-License-Identifier: Apache-2.0
"""A run from left to right: segments, touches, updates, and what else happened."""

from collections.abc import Callable
from html import escape

from srnn_bringup.page.bag_run import BagRun
from srnn_view.events import Grave

WIDTH, LEFT = 1000.0, 90.0
ROW, GAP = 20.0, 9.0
COLOURS = {Grave.NOTE: '#6c757d', Grave.WARN: '#e08e45', Grave.ERROR: '#c1121f'}
ROWS = ('segments', 'touches', 'updates', 'events')
TICKS = (0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800, 3600)
MOST_TICKS = 9


def timeline(run: BagRun) -> str:
    """Return the timeline as SVG; every mark says what it is when pointed at."""
    top = {name: index * (ROW + GAP) for index, name in enumerate(ROWS)}
    height = len(ROWS) * (ROW + GAP) + 26.0
    scale = (WIDTH - LEFT - 8.0) / max(run.seconds, 1e-9)

    def at(time: float) -> float:
        return LEFT + scale * time

    marks = []
    for record in run.recorder.records:
        begin = run.sent.get(record.plan.stamp_ns, 0.0)
        colour = '#c1121f' if record.touched else '#1f6f8b'
        words = f'segment {record.number}: {record.result.code.value}, {begin:.1f} s'
        width = max(scale * record.plan.duration - 1.0, 1.0)
        marks.append(_bar(at(begin), top['segments'], width, colour, words))
        if record.touched:
            marks.append(_bar(at(begin), top['touches'], 4.0, '#c1121f', words))
    for time, weights in run.versions:
        words = f'weights version {weights.version}, {time:.1f} s'
        marks.append(_bar(at(time), top['updates'], 4.0, '#e08e45', words))
    for event in run.events:
        words = f'{event.time:.1f} s, {event.source}: {event.text}'
        marks.append(_bar(at(event.time), top['events'], 3.0, COLOURS[event.grave], words))
    names = ''.join(
        f'<text x="0" y="{top[name] + 15:.0f}" font-size="15" fill="#6c757d">{name}</text>'
        for name in ROWS
    )
    return (
        f'<div class="scroll"><svg viewBox="0 0 {WIDTH:.0f} {height:.0f}" role="img" '
        f'aria-label="timeline" style="min-width:40rem">{names}{"".join(marks)}'
        f'{_axis(run.seconds, at, height)}</svg></div>'
    )


def _bar(x: float, y: float, width: float, colour: str, words: str) -> str:
    return (
        f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{ROW:.0f}" fill="{colour}">'
        f'<title>{escape(words)}</title></rect>'
    )


def _axis(seconds: float, at: Callable[[float], float], height: float) -> str:
    step = next((tick for tick in TICKS if seconds / tick <= MOST_TICKS), TICKS[-1])
    parts = []
    time = 0.0
    while time <= seconds:
        parts.append(
            f'<text x="{at(time):.1f}" y="{height - 4:.0f}" font-size="14" fill="#6c757d" '
            f'text-anchor="middle">{time:g} s</text>'
        )
        time += step
    return ''.join(parts)
