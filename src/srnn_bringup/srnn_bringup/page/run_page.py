# SPDX-License-Identifier: Apache-2.0
"""The page of a recorded run."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
import tempfile

import numpy as np
from numpy.typing import NDArray

from srnn_bringup.closing_lines import closing_lines
from srnn_bringup.page import html
from srnn_bringup.page.bag_run import BagRun
from srnn_bringup.page.timeline import timeline
from srnn_bringup.page.timings import PERCENTILES, spread, timings
from srnn_bringup.plots.plane import draw_change
from srnn_bringup.plots.style import figure_file
from srnn_bringup.run_outputs import Outputs, write_report
from srnn_bringup.trial import Run, document
from srnn_config.geometry import outline
from srnn_msgs_py.weights import LearnedWeights
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synaptic_change import input_change, output_change
from srnn_view.events import Grave

MAPS = 12
"""Updates that are drawn one by one; of more, these many from the first to the last."""

EVENTS = 200
ANIMATION_HZ = 25.0


@dataclass(frozen=True, eq=False)
class Update:
    """One update of the weights: the version that it led to, when [s], and what is learned."""

    version: int
    time: float
    before: LearnedWeights
    after: LearnedWeights


def run_page(run: BagRun) -> str:
    """Return the page of a run."""
    task = run.configuration.scene.task
    told = Run(
        run.about.get('nodes', ()), run.seconds, task.blocked, len(run.recorder.records)
    )
    trial = document(run.configuration, run.recorder, told)['trials'][0]
    lines = list(closing_lines(trial, told.blocked))
    force = trial['contact_force_peak_n']
    rmse = trial['tracking_rmse_m']
    figures = [
        ('segments', str(trial['segments_executed'])),
        ('touches', str(trial['contacts'])),
        ('touches in the last third', str(trial['contacts_last_third'])),
        ('updates', str(trial['updates_triggered'])),
        ('laps', str(trial['laps'])),
        ('tracking error, rms', '-' if rmse is None else f'{1e3 * rmse:.2f} mm'),
        ('largest contact force', '-' if force is None else f'{force:.0f} N'),
        ('duration', f'{run.seconds:.0f} s'),
    ]
    with tempfile.TemporaryDirectory() as folder:
        return html.page(
            f'{run.bag.path.name}: scene {task.name}, signal {run.configuration.learning.signal}',
            [
                html.paragraph(' '.join(f'{line}.' for line in lines)),
                html.cards(figures),
                _animation(run),
                html.section('What happened when', timeline(run), _events(run)),
                *_pictures(run, told, Path(folder)),
                html.section('How long things took', _timings(run)),
                html.section('What ran', _about(run)),
            ],
        )


def _animation(run: BagRun) -> str:
    scene = run.configuration.scene
    step = max(1, round(len(run.tip) / max(run.seconds * ANIMATION_HZ, 1.0)))
    tip = run.tip[::step]
    plans = [r.plan for r in run.recorder.records]
    data = {
        'seconds': round(run.seconds, 2),
        'edge': 330,
        'reach': 1e3 * scene.task.reach_radius,
        'waypoints': _mm(np.array(scene.waypoints)),
        'obstacles': [_mm(np.array(outline(o))) for o in scene.obstacles],
        't': [round(float(t), 2) for t in tip[:, 0]],
        'tip': _mm(tip[:, 1:]),
        'sent': [round(run.sent.get(p.stamp_ns, 0.0), 2) for p in plans],
        'plans': [_mm(p.positions[:, :2]) for p in plans],
        'touches': [
            [round(run.sent.get(r.plan.stamp_ns, 0.0), 2), *_mm(r.executed.positions[-1:, :2])[0]]
            for r in run.recorder.records if r.touched
        ],
    }  # fmt: skip
    controls = (
        '<div class="controls"><button id="play">Play</button>'
        '<input id="time" type="range" min="0" aria-label="time"><span id="clock"></span>'
        '<label>speed <select id="speed"><option value="1">1</option>'
        '<option value="4" selected>4</option><option value="16">16</option></select></label>'
        '</div>'
    )
    return html.section(
        'The run', '<canvas id="run"></canvas>', controls,
        html.paragraph('Orange: the plan. Blue: the tip, its last 20 s dark. Red: touches.'),
        html.script('animation.js', RUN=data),
    )  # fmt: skip


def _mm(points: NDArray[np.float64]) -> list[list[float]]:
    return [[round(1e3 * float(value), 1) for value in point[:2]] for point in points]


def _events(run: BagRun) -> str:
    events = run.events[:EVENTS]
    rows = [(f'{event.time:.1f} s', event.source, event.text) for event in events]
    more = len(run.events) - len(events)
    note = html.paragraph(f'{more} more are in the bag.') if more else ''
    classes = ['error' if event.grave is Grave.ERROR else '' for event in events]
    return html.table(('time', 'who', 'what'), rows, classes=classes) + note


def _pictures(run: BagRun, told: Run, folder: Path) -> Iterator[str]:
    """Yield the picture of the run and the maps of what each update has changed."""
    if run.recorder.records:
        whole = folder / 'run.png'
        write_report(run.configuration, run.recorder, told, Outputs(whole), lambda _: None)
        yield html.section(
            'What was learned',
            html.picture(whole, 'Path before and after learning; what has changed; the signal.'),
        )
    changes = list(_updates(run))
    if changes:
        shown = sorted({*np.linspace(0, len(changes) - 1, MAPS).round().astype(int).tolist()})
        maps = (_map(run, changes[index], folder) for index in shown)
        yield html.section('What each update changed', f'<div class="grid">{"".join(maps)}</div>')


def _updates(run: BagRun) -> Iterator[Update]:
    for (_, before), (time, after) in zip(run.versions, run.versions[1:], strict=False):
        if not before.learned.same_as(after.learned):
            yield Update(after.version, time, before.learned, after.learned)


def _map(run: BagRun, update: Update, folder: Path) -> str:
    file = folder / f'{update.version}.png'
    model = run.configuration.network.model
    neurons = StateNeurons(model.network)
    change = neurons.synapses(update.after), neurons.synapses(update.before)
    with figure_file(file, (3.6, 3.4), f'version {update.version}') as figure:
        axes = figure.add_subplot()
        metres = model.workspace.to_metres(neurons.positions)
        draw_change(axes, metres, input_change(*change), output_change(*change))
        axes.set_aspect('equal')
        axes.set_xticks([])
        axes.set_yticks([])
    return html.picture(file, f'after {update.time:.1f} s')


def _timings(run: BagRun) -> str:
    rows = [
        (name, str(len(times)), *(f'{value:.2f}' for value in spread(times)))
        for name, times in timings(run).items()
    ]
    heading = ('[ms]', 'count', *PERCENTILES)
    return html.table(heading, rows, numbers=5)


def _about(run: BagRun) -> str:
    versions = run.about.get('versions', {})
    rows = [
        ('command', f'srnn {" ".join(run.about.get("command", []))}'),
        ('arm', str(run.about.get('arm', 'unknown'))),
        ('seed', str(run.configuration.seed)),
        ('nodes', ', '.join(run.about.get('nodes', []))),
        *((name, str(value)) for name, value in versions.items()),
        ('recording', 'complete' if run.bag.complete else 'its recorder was killed'),
        ('attached', ', '.join(run.bag.attachments)),
    ]
    return html.table(('', ''), rows)
