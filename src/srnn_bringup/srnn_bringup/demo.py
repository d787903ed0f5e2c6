# SPDX-License-Identifier: Apache-2.0
"""`srnn demo`: the arm learns an obstacle, live, and ends with a report."""

from dataclasses import dataclass
from pathlib import Path
import sys
import time

from srnn_bringup.config import Configuration
from srnn_bringup.console import Console
from srnn_bringup.errors import BringupError, Interrupted, NotReadyError
from srnn_bringup.exit_codes import DONE, FAILED, by_signal
from srnn_bringup.live_graph import LiveGraph
from srnn_bringup.observer import Observer
from srnn_bringup.run_outputs import Outputs, write_report
from srnn_bringup.run_recorder import Recorder, start_recording
from srnn_bringup.trial import Run
from srnn_bringup.viewer import viewing
from srnn_node.signals import StopRequest

DISCOVERY_S = 15.0
"""Longest wait for the topics of the graph [s]."""

SILENCE_S = 30.0
"""A run in which no segment ends for this long has failed [s]."""


@dataclass
class Progress:
    """What of a run has been shown so far, and when it began."""

    shown: int = 0
    refused: int = 0
    began: float | None = None
    last_end: float = 0.0

    @property
    def wall_s(self) -> float:
        """Time from the activation to the end of the last segment [s]."""
        return 0.0 if self.began is None else max(self.last_end - self.began, 0.0)


def run_demo(
    configuration: Configuration,
    segments: int,
    outputs: Outputs,
    bag: Path | None = None,
    view: int | None = None,
) -> int:
    """Run the graph until enough segments have ended, and report, whatever happens.

    Args:
        configuration: what the nodes are told.
        segments: number of segments to execute.
        outputs: files to write.
        bag: new directory to record to; None to record nothing.
        view: port of a page that shows the run; None for no page.

    Returns:
        Exit code, see `srnn_bringup.exit_codes`: 0 after all segments.

    """
    console = Console(sys.stdout)
    recorder = start_recording(configuration)
    progress = Progress()
    names: tuple[str, ...] = ()
    code = DONE
    with StopRequest() as stop:
        try:
            with (
                viewing(configuration, view, console.note),
                LiveGraph(configuration, stop, console.note, bag=bag) as graph,
            ):
                names = graph.names
                observer = Observer(graph.node, recorder, configuration.key())
                _run(graph, observer, console, progress, segments)
        except Interrupted as wish:
            code = by_signal(str(wish))
            console.note(f'stopped by {wish}')
        except BringupError as error:
            code = FAILED
            print(f'srnn demo: {error}', file=sys.stderr, flush=True)
        run = Run(names, progress.wall_s, configuration.scene.task.blocked, segments)
        write_report(configuration, recorder, run, outputs, console.note)
    return code


def _run(
    graph: LiveGraph, observer: Observer, console: Console, progress: Progress, segments: int
) -> None:
    graph.configure()
    if not graph.pump.until(observer.connected, DISCOVERY_S):
        raise NotReadyError(f'the topics of the graph do not appear within {DISCOVERY_S:g} s')
    graph.activate()
    console.heading()
    progress.began = progress.last_end = time.monotonic()
    while progress.shown < segments:
        graph.pump.turn()
        _show(observer.recorder, console, progress, segments)
        if time.monotonic() - progress.last_end > SILENCE_S:
            raise NotReadyError(f'no segment has ended for {SILENCE_S:g} s')


def _show(recorder: Recorder, console: Console, progress: Progress, segments: int) -> None:
    for result in recorder.refused[progress.refused :]:
        console.refused(result)
        progress.refused += 1
    for record in recorder.records[progress.shown : segments]:
        console.segment(record)
        progress.shown += 1
        progress.last_end = time.monotonic()
