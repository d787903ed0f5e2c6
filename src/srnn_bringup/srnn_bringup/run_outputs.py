# SPDX-License-Identifier: Apache-2.0
"""What a run leaves behind: picture, figures and weights."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from srnn_bringup.closing_lines import closing_lines
from srnn_bringup.config import Configuration
from srnn_bringup.run_recorder import Recorder
from srnn_bringup.speech import write_document
from srnn_bringup.trial import Run, document
from srnn_planner.core import weights_file
from srnn_planner.core.synapses import Synapses


@dataclass(frozen=True)
class Outputs:
    """Files to write; None for those that are not wanted.

    Attributes:
        picture: picture of the run.
        json: its figures; may be `STDOUT`.
        weights: the weights at its end.

    """

    picture: Path | None = None
    json: Path | None = None
    weights: Path | None = None


def write_report(
    configuration: Configuration,
    recorder: Recorder,
    run: Run,
    outputs: Outputs,
    say: Callable[[str], None],
) -> None:
    """Write the files of a run, and say its figures and what was written.

    Raises:
        OSError: a file cannot be written.

    """
    report = document(configuration, recorder, run)
    if outputs.json is not None:
        write_document(outputs.json, report)
        say(f'figures: {outputs.json}')
    if outputs.weights is not None and recorder.last_weights is not None:
        weights_file.save(outputs.weights, recorder.last_weights)
        say(f'weights: {outputs.weights}')
    if not recorder.records:
        say('no segment was executed')
        return
    if outputs.picture is not None:
        _draw(configuration, recorder, run, outputs.picture)
        say(f'picture: {outputs.picture}')
    for line in closing_lines(report['trials'][0], run.blocked):
        say(line)


def _draw(configuration: Configuration, recorder: Recorder, run: Run, path: Path) -> None:
    # Drawing needs a second to load, which nobody should wait for before the arm moves.
    from srnn_bringup.picture import Story, draw

    before = after = configuration.start_weights()
    if recorder.last_weights is not None:
        after = Synapses.checked(before.prior, recorder.last_weights.learned)
    draw(Story(configuration, recorder.records[: run.limit], before, after), path)
