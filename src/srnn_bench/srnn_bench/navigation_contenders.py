# SPDX-License-Identifier: Apache-2.0
"""Who goes from way point to way point around a known obstacle."""

from dataclasses import dataclass

from srnn_bench.contender import Contender
from srnn_bench.mppi import MppiParameters
from srnn_bench.navigation_task import ROOM, NavigationTask
from srnn_bench.ompl_budget import BUDGET
from srnn_bench.peers import OMPL
from srnn_planner.core.parameters import ModelParameters, PlanningParameters


@dataclass(frozen=True, eq=False)
class NavigationSetting:
    """What all contenders are built from.

    Attributes:
        task: where to go, and what is in the way.
        model: the network.
        planning: how one segment is planned.
        seed: first of the seeds.

    """

    task: NavigationTask
    model: ModelParameters
    planning: PlanningParameters
    seed: int


_MPPI = MppiParameters()

_CHECKED = (
    f'leaves {1e3 * ROOM:.0f} mm to the obstacle; one query a leg; validity is looked up in a '
    'map by a Python function'
)

NAVIGATION_CONTENDERS: tuple[Contender[NavigationSetting], ...] = (
    Contender(
        'known', 'srnn, told of the obstacle',
        'plans a segment at a time, until one ends at the way point', 'known_navigator',
        'KnownNavigator', lambda setting: (setting.task, setting.model, setting.planning),
    ),
    Contender(
        'a-star', 'A*', f'leaves {1e3 * ROOM:.0f} mm; one query a leg; cells of 10 mm with 8 '
        'neighbours, in Python; the path is not straightened', 'grid_navigator', 'GridNavigator',
        lambda setting: (setting.task,),
    ),
    Contender(
        'rrt-connect', 'OMPL, RRT-Connect', f'{_CHECKED}; with simplification', 'ompl_navigator',
        'OmplNavigator', lambda setting: (setting.task, 'RRTConnect', True, setting.seed),
        OMPL,
    ),
    Contender(
        'rrt-star', 'OMPL, RRT*',
        f'{_CHECKED}; uses all of its {1e3 * BUDGET:.0f} ms', 'ompl_navigator',
        'OmplNavigator', lambda setting: (setting.task, 'RRTstar', False, setting.seed),
        OMPL,
    ),
    Contender(
        'mppi', 'MPPI, NumPy', f'leaves {1e3 * ROOM:.0f} mm; plans a step of '
        f'{1e3 * _MPPI.period:.0f} ms at a time: {_MPPI.rollouts} paths of '
        f'{_MPPI.period * _MPPI.horizon:.0f} s; a point that obeys velocities at once',
        'mppi_navigator', 'MppiNavigator', lambda setting: (setting.task, _MPPI),
    ),
)  # fmt: skip
