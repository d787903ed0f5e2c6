# SPDX-License-Identifier: Apache-2.0
"""Who runs the same network."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from srnn_bench.contender import Contender
from srnn_bench.peers import BRIAN2, NEST
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

if TYPE_CHECKING:
    from srnn_bench.network_task import NetworkTask


@dataclass(frozen=True, eq=False)
class NetworkSetting:
    """What all contenders are built from.

    Attributes:
        model: the network.
        planning: how one segment is planned.
        seed: decides where the context neurons lie.

    """

    model: ModelParameters
    planning: PlanningParameters
    seed: int

    @property
    def task(self) -> 'NetworkTask':
        """The network, with weights and context neurons."""
        from srnn_bench.network_task import standard_task

        return standard_task(self.model, self.planning, self.seed)


SAMPLER = 'sampler'
PLANNER = 'planner'
"""The rows that all others are compared with."""

_AT_ONCE = 'all samples at once'
_ONE_BY_ONE = 'one sample after another'
_PREPARED = 'Brian2 prepares its code anew for every sample'

NETWORK_CONTENDERS: tuple[Contender[NetworkSetting], ...] = (
    Contender(
        SAMPLER, 'srnn, sampler alone',
        'history and random numbers drawn, spikes of all samples', 'compiled_network',
        'CompiledSampler', lambda setting: (setting.task, setting.planning),
    ),
    Contender(
        PLANNER, 'srnn, whole planning',
        'sampling, decoding, selection and timing of the segment', 'compiled_network',
        'WholePlanning', lambda setting: (setting.model, setting.planning, setting.seed),
    ),
    Contender(
        'numpy', 'NumPy reference', 'history and random numbers drawn, spikes of all samples',
        'numpy_network', 'NumpyNetwork', lambda setting: (setting.task,),
    ),
    Contender(
        'brian2-numpy', f'Brian2, target numpy, {_AT_ONCE}', 'no compiler needed',
        'brian2_network', 'Brian2Network', lambda setting: (setting.task, 'numpy'), BRIAN2,
    ),
    Contender(
        'brian2-numpy-one', f'Brian2, target numpy, {_ONE_BY_ONE}',
        f'no compiler needed; {_PREPARED}', 'brian2_network', 'Brian2OneAfterAnother',
        lambda setting: (setting.task, 'numpy'), BRIAN2, slow=True,
    ),
    Contender(
        'brian2-cython', f'Brian2, target cython, {_AT_ONCE}', '', 'brian2_network',
        'Brian2Network', lambda setting: (setting.task, 'cython'), BRIAN2, ('g++',),
    ),
    Contender(
        'brian2-cython-one', f'Brian2, target cython, {_ONE_BY_ONE}', _PREPARED,
        'brian2_network', 'Brian2OneAfterAnother', lambda setting: (setting.task, 'cython'),
        BRIAN2, ('g++',), slow=True,
    ),
    Contender(
        'brian2-cpp', f'Brian2, target cpp_standalone, {_AT_ONCE}',
        'steps by its own clock; the program is started for each segment', 'brian2_standalone',
        'Brian2Standalone', lambda setting: (setting.task,), BRIAN2, ('g++', 'make'),
    ),
    Contender(
        'brian2-cpp-one', f'Brian2, target cpp_standalone, {_ONE_BY_ONE}',
        'steps by its own clock; the program is started for each sample', 'brian2_standalone',
        'Brian2StandaloneOneAfterAnother', lambda setting: (setting.task,), BRIAN2,
        ('g++', 'make'),
    ),
    Contender(
        'nest', f'NEST, pp_psc_delta, {_AT_ONCE}',
        'spike probability 1 - exp(-exp(beta u - c)), without the limit p_max, for which it has '
        'no parameter: more spikes; activity of context neurons drawn before the steps',
        'nest_network', 'NestNetwork', lambda setting: (setting.task,), NEST,
    ),
    Contender(
        'nest-one', f'NEST, pp_psc_delta, {_ONE_BY_ONE}', 'as with all samples at once',
        'nest_network', 'NestOneAfterAnother', lambda setting: (setting.task,), NEST,
    ),
)  # fmt: skip
