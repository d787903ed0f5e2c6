# SPDX-License-Identifier: Apache-2.0
"""Every figure of the evaluation: how it is computed, what it says, how it is drawn."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from srnn_bringup.plots import collapse as collapse_plot
from srnn_bringup.plots import learning_signals as learning_signals_plot
from srnn_bringup.plots import mental_plan as mental_plan_plot
from srnn_bringup.plots import signal_magnitudes as signal_magnitudes_plot
from srnn_bringup.plots import synaptic_change as synaptic_change_plot
from srnn_bringup.plots import visits as visits_plot
from srnn_experiments.evaluation import (
    collapse,
    learning_signals,
    mental_plan,
    signal_magnitudes,
    synaptic_change,
    visit_times,
)
from srnn_experiments.evaluation.trials import Evaluation

Found = dict[str, Any]


class Content(Protocol):
    """What a figure shows and says; a module of `srnn_experiments.evaluation`."""

    def numbers(self, evaluation: Evaluation) -> Found:
        """Return all that it shows, as plain data."""

    def headline(self, found: Found) -> str:
        """Return its finding in one line."""

    def caption(self, found: Found) -> str:
        """Return what it shows, in words."""

    def key_numbers(self, found: Found) -> list[str]:
        """Return what is worth reading of its numbers, line by line."""


@dataclass(frozen=True)
class PaperFigure:
    """One figure.

    Attributes:
        content: what it shows and says.
        draw: draws the numbers under a headline into a file; needs nothing else.

    """

    content: Content
    draw: Callable[[Found, str, Path], None]


FIGURES = {
    'mental_plan': PaperFigure(mental_plan, mental_plan_plot.draw),
    'synaptic_change': PaperFigure(synaptic_change, synaptic_change_plot.draw),
    'learning_signals': PaperFigure(learning_signals, learning_signals_plot.draw),
    'visits': PaperFigure(visit_times, visits_plot.draw),
    'signal_magnitudes': PaperFigure(signal_magnitudes, signal_magnitudes_plot.draw),
    'collapse': PaperFigure(collapse, collapse_plot.draw),
}
"""By the name of their files."""
