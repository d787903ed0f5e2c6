# SPDX-License-Identifier: Apache-2.0
"""Maps of what has changed in the network, for each learning signal side by side."""

from pathlib import Path
from typing import Any

import numpy as np

from srnn_bringup.plots.plane import (
    draw_change,
    draw_obstacles,
    draw_waypoints,
    reach,
    show_square,
)
from srnn_bringup.plots.style import figure_file, signed

SIZE = (12.5, 6.5)


def draw(found: dict[str, Any], headline: str, path: Path) -> None:
    """Draw the figure into a file."""
    signals = found['signals']
    neurons, place = np.array(found['neurons_m']), found['place']
    limits = {
        side: max(abs(value) for signal in signals.values() for value in signal[side])
        for side in ('input', 'output')
    }
    with figure_file(path, SIZE, headline) as figure:
        row = figure.subplots(1, len(signals), sharey=True)
        for axes, (name, signal) in zip(row, signals.items(), strict=True):
            image = draw_change(
                axes, neurons, np.array(signal['input']), np.array(signal['output']),
                limits['input'], limits['output'],
            )  # fmt: skip
            draw_obstacles(axes, place['obstacles_m'], 'none')
            draw_waypoints(axes, place['waypoints_m'], place['reach_radius_m'])
            show_square(
                axes,
                [*reach(place['waypoints_m'], place['reach_radius_m']), *place['obstacles_m']],
            )
            axes.set_title(f'{name} signal, mean of {len(found["seeds"])} trials', fontsize=13)
            axes.set_xlabel(
                f'strongest change: input {signed(signal["strongest_input"], 3)}, '
                f'output {signed(signal["strongest_output"], 3)}'
            )
        figure.colorbar(image, ax=row, label='average change of synaptic input', shrink=0.85)
        figure.supxlabel(
            f'circles: neurons, larger where output has changed (largest: '
            f'{limits["output"]:.3f})', fontsize=12,
        )  # fmt: skip
