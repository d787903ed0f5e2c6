# SPDX-License-Identifier: Apache-2.0
"""Both tables, measured in one run."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from srnn_bench.contender import check_names, chosen
from srnn_bench.machine import machine_facts
from srnn_bench.markdown import listing, table
from srnn_bench.navigation_contenders import NAVIGATION_CONTENDERS, NavigationSetting
from srnn_bench.navigation_table import (
    NAVIGATION_COLUMNS,
    NavigationRow,
    measure_navigation,
    navigation_cells,
    navigation_figures,
)
from srnn_bench.navigation_task import navigation_task
from srnn_bench.network_contenders import NETWORK_CONTENDERS, NetworkSetting
from srnn_bench.network_table import (
    NETWORK_COLUMNS,
    SLOW_ROUNDS,
    TURN,
    NetworkRow,
    measure_network,
    network_cells,
    network_figures,
)
from srnn_config.scene import Scene
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

NAMES = (*(c.name for c in NETWORK_CONTENDERS), *(c.name for c in NAVIGATION_CONTENDERS))
"""Names of all rows."""

REPEATS = 20
"""Rounds, and seeds of stochastic planners."""

_NETWORK = """\
One segment is planned: {samples} movements of {steps} steps of {neurons} state neurons, all on one
thread. The rows take turns of {turn} runs, so that all see the same machine, and the run before
each turn does not count; p50 and p95 of {repeats} rounds. Where a run takes seconds, a turn is one
run, in every {slow} rounds.

A simulator can run all samples *at once*, as one network of {samples} times {neurons} neurons, or
*one after another*, as one network of {neurons}: the plain way. Of simulators p50 and p95 count
the {steps} steps alone, which favours them; of the rows above them they count all. *Whole call* is
what a caller waits for, with history, state set back, run prepared, program started, spikes read.
*Times the sampler* and *times whole planning* are ratios of the first column.
Building is what comes before the first result: process, code, synapses, one run; code that an
earlier run has compiled and kept is used.\
"""

_NAVIGATION = """\
Scene {scene}: from each way point to the next, until it is closer than {reach:.0f} mm; {repeats}
tours, each with a seed of its own. The tool is a disc of {radius:.0f} mm; the shortest way touches
the obstacle, and the way of nobody may. What was planned is followed perfectly. Room is the
distance between tool and obstacle. A leg is done when the way point was reached without contact.\
"""


@dataclass(frozen=True, eq=False)
class Asked:
    """What the bench is asked for.

    Attributes:
        scene: the tour of table 2.
        repeats: rounds, and seeds of stochastic planners.
        seed: first of the seeds.
        only: names of rows; () for all.
        command: how it was asked, for the report.

    Raises:
        ChoiceError: there is no row of a name.

    """

    scene: Scene
    repeats: int
    seed: int
    only: tuple[str, ...]
    command: str

    def __post_init__(self) -> None:
        check_names(self.only, NAMES)


@dataclass(frozen=True, eq=False)
class Results:
    """What was measured.

    Attributes:
        facts: machine and versions.
        network: rows of table 1.
        navigation: rows of table 2.

    """

    asked: Asked
    setting: NavigationSetting
    facts: dict[str, str]
    network: Sequence[NetworkRow]
    navigation: Sequence[NavigationRow]

    def markdown(self) -> str:
        """Return a report."""
        sampling = self.setting.planning.sampling
        task, asked = self.setting.task, self.asked
        parts = ['# srnn beside others', f'`{asked.command}`', listing(self.facts)]
        if self.network:
            text = _NETWORK.format(
                samples=sampling.samples, steps=sampling.steps, repeats=asked.repeats,
                neurons=self.setting.model.network.neurons, turn=TURN, slow=SLOW_ROUNDS,
            )  # fmt: skip
            cells = network_cells(self.network)
            parts += ['## The same network', text, table(NETWORK_COLUMNS, cells)]
        if self.navigation:
            text = _NAVIGATION.format(
                scene=asked.scene.task.name, repeats=asked.repeats, reach=1e3 * task.reach,
                radius=1e3 * task.radius,
            )  # fmt: skip
            cells = navigation_cells(self.navigation, task)
            parts += [
                '## The same task, the obstacle known', text, table(NAVIGATION_COLUMNS, cells)
            ]  # fmt: skip
        return '\n\n'.join(parts) + '\n'

    def document(self) -> dict[str, Any]:
        """Return all figures as plain data for JSON."""
        return {
            'command': self.asked.command,
            'machine': self.facts,
            'scene': self.asked.scene.task.name,
            'repeats': self.asked.repeats,
            'seed': self.asked.seed,
            'network': network_figures(self.network),
            'navigation': navigation_figures(self.navigation),
        }


def run_bench(asked: Asked, say: Callable[[str], None]) -> Results:
    """Measure both tables; `say` is told what goes on."""
    facts = machine_facts()
    model, planning = ModelParameters(), PlanningParameters()
    navigation = NavigationSetting(navigation_task(asked.scene), model, planning, asked.seed)
    runners = chosen(NETWORK_CONTENDERS, asked.only)
    navigators = chosen(NAVIGATION_CONTENDERS, asked.only)
    seeds = range(asked.seed, asked.seed + asked.repeats)
    network_setting = NetworkSetting(model, planning, asked.seed)
    return Results(
        asked, navigation, facts,
        measure_network(runners, network_setting, asked.repeats, say) if runners else (),
        measure_navigation(navigators, navigation, seeds, say) if navigators else (),
    )  # fmt: skip
