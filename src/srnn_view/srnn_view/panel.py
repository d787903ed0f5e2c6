# SPDX-License-Identifier: Apache-2.0
"""The figures beside the scene: what was learned, how long it took, who is well."""

from collections.abc import Iterable
from html import escape

import numpy as np
import viser
from viser import uplot

from srnn_msgs_py.health import HealthLevel
from srnn_msgs_py.result import ResultCode
from srnn_view.events import Event, Grave
from srnn_view.live_run import LiveRun, Part
from srnn_view.pictures import Pixels, map_of, raster

SHOWN_EVENTS = 12

_GRAVE = {Grave.NOTE: '#666', Grave.WARN: '#b36b00', Grave.ERROR: '#c00020'}
_LEVEL = {
    HealthLevel.OK: '#2e8b57', HealthLevel.WARN: '#b36b00', HealthLevel.ERROR: '#c00020',
    HealthLevel.STALE: '#666',
}  # fmt: skip
_EMPTY = np.zeros((8, 8, 3), np.uint8)
_MAP_PIXELS = 20


class Panel:
    """Draws a run into the panel of a page."""

    def __init__(self, gui: viser.GuiApi) -> None:
        """Put up empty figures."""
        gui.set_panel_label('srnn')
        gui.configure_theme(
            control_layout='fixed', control_width='large', show_logo=False,
            # It would have another server show the page to everybody.
            show_share_button=False,
        )
        tabs = gui.add_tab_group()
        with tabs.add_tab('Learning'):
            self._counts = gui.add_html('')
            self._lessons = _chart(
                gui, 'dissonance', 'peak', ('of the segment', '#888'),
                ('where weights changed', '#c00020'),
            )  # fmt: skip
            self._spikes = gui.add_image(
                _EMPTY, label='spikes: a row per neuron, steps to the right', format='png'
            )
            self._belief = gui.add_image(_EMPTY, label='learned inhibition', format='png')
        with tabs.add_tab('Times'):
            self._planning = _chart(gui, 'planning', 'ms', ('planning', '#1e64dc'))
            self._updates = _chart(gui, 'learning from a touch', 'ms', ('update', '#c00020'))
        with tabs.add_tab('Nodes'):
            self._nodes = gui.add_html('')
        with tabs.add_tab('Events'):
            self._events = gui.add_html('')

    def draw(self, run: LiveRun, changed: Iterable[Part]) -> None:
        """Bring the figures up to date."""
        draw = {
            Part.COUNTS: self._draw_counts,
            Part.LESSONS: self._draw_lessons,
            Part.PLANNING: self._draw_planning,
            Part.SPIKES: self._draw_spikes,
            Part.BELIEF: self._draw_belief,
            Part.NODES: self._draw_nodes,
            Part.EVENTS: self._draw_events,
        }
        for part in changed:
            if part in draw:
                draw[part](run)

    def _draw_counts(self, run: LiveRun) -> None:
        updates = sum(updated for _, _, updated in run.lessons)
        figures = {
            'segments': str(run.ended),
            'touches': str(run.counts[ResultCode.BLOCKED]),
            'updates': str(updates),
            'force': f'{run.force:.0f} N',
        }
        self._counts.content = _table(
            [[f'<b id="srnn-{name}">{value}</b> {name}' for name, value in figures.items()]]
        )

    def _draw_lessons(self, run: LiveRun) -> None:
        self._draw_counts(run)
        if run.lessons:
            number, peak, updated = (np.array(column) for column in zip(*run.lessons, strict=True))
            self._lessons.data = number.astype(float), peak, np.where(updated, peak, 0.0)

    def _draw_planning(self, run: LiveRun) -> None:
        for chart, points in ((self._planning, run.planning), (self._updates, run.updates)):
            if points:
                number, milliseconds = np.array(points, dtype=float).T
                chart.data = (number, milliseconds)

    def _draw_spikes(self, run: LiveRun) -> None:
        if run.spikes is not None:
            self._spikes.image = raster(run.spikes)

    def _draw_belief(self, run: LiveRun) -> None:
        if run.belief is not None:
            self._belief.image = _on_white(map_of(run.belief.inhibition, _MAP_PIXELS))

    def _draw_nodes(self, run: LiveRun) -> None:
        self._nodes.content = _table(
            [_dot(_LEVEL[health.level]), f'<b>{escape(name)}</b>', escape(health.message)]
            for name, health in sorted(run.health.items())
        )

    def _draw_events(self, run: LiveRun) -> None:
        self._events.content = _table(
            map(_event, reversed(run.log.events[-SHOWN_EVENTS:]))
        )  # fmt: skip


def _chart(
    gui: viser.GuiApi, title: str, unit: str, *series: tuple[str, str]
) -> viser.GuiUplotHandle:
    """Return a chart over the number of the segment."""
    lines = tuple(
        uplot.Series(label=label, stroke=colour, width=1.5, points={'show': True, 'size': 5})
        for label, colour in series
    )
    return gui.add_uplot(
        tuple(np.zeros(1) for _ in (0, *series)),
        (uplot.Series(label='segment'), *lines),
        title=title,
        axes=(uplot.Axis(label='segment'), uplot.Axis(label=unit)),
        scales={'x': uplot.Scale(time=False, auto=True)},
        aspect=1.8,
    )


def _event(event: Event) -> list[str]:
    time = f'<nobr>{event.time:.1f} s</nobr>'
    source = f'<b>{escape(event.source)}</b>'
    return [_dot(_GRAVE[event.grave]), time, source, escape(event.text)]


def _dot(colour: str) -> str:
    return f'<span style="color:{colour}">&#9679;</span>'


def _table(rows: Iterable[Iterable[str]]) -> str:
    cells = (
        ''.join(f'<td style="padding:2px 6px;vertical-align:top">{cell}</td>' for cell in row)
        for row in rows
    )
    body = ''.join(f'<tr>{row}</tr>' for row in cells)
    return f'<table style="font-size:13px;margin:4px 8px">{body}</table>'


def _on_white(picture: Pixels) -> Pixels:
    """Return a picture with transparent parts (n, m, 4) on white (n, m, 3)."""
    share = picture[..., 3:].astype(np.float64) / 255.0
    return np.asarray(share * picture[..., :3] + (1.0 - share) * 255.0, np.uint8)
