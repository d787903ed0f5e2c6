# SPDX-License-Identifier: Apache-2.0
"""The last lines of a run: what it came to."""

from collections.abc import Iterator, Mapping
from typing import Any


def closing_lines(trial: Mapping[str, Any], blocked: int) -> Iterator[str]:
    """Yield the figures of a trial in words.

    Args:
        trial: as `srnn_bringup.trial.figures` returns it.
        blocked: index of the way point behind the obstacle.

    """
    yield (
        f'{_count(trial["segments_executed"], "segment")} in {trial["wall_s"]:.0f} s: '
        f'{_count(trial["contacts"], "touch", "touches")} '
        f'({trial["contacts_last_third"]} in the last third), '
        f'{_count(trial["updates_triggered"], "update")}'
    )
    visits = trial['segments_to_blocked']
    each = f', after {", ".join(map(str, visits))} segments' if visits else ''
    yield (
        f'{_count(trial["waypoints_reached"], "way point")} reached, '
        f'{_count(trial["laps"], "lap")}; way point {blocked + 1} behind the obstacle '
        f'{_count(len(visits), "time")}{each}'
    )
    yield (
        f'planning {_figure(trial["planning_ms"]["p50"], "ms")}, '
        f'update {_figure(trial["update_ms"]["p50"], "ms")} (medians), '
        f'tracking error {_figure(trial["tracking_rmse_m"], "mm", 1e3)} rms, '
        f'contact force up to {_figure(trial["contact_force_peak_n"], "N")}'
    )


def _count(number: int, one: str, many: str = '') -> str:
    return f'{number} {one}' if number == 1 else f'{number} {many or one + "s"}'


def _figure(value: float | None, unit: str, scale: float = 1.0) -> str:
    if value is None:
        return '-'
    value *= scale
    return f'{value:.0f} {unit}' if value >= 10.0 else f'{value:.2f} {unit}'
