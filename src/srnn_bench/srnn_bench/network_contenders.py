# SPDX-License-Identifier: Apache-2.0
"""Who runs the same network."""

from dataclasses import dataclass

from srnn_bench.contender import Contender
from srnn_bench.network_task import NetworkTask, standard_task
from srnn_bench.peers import BRIAN2, NEST
from srnn_planner.core.parameters import ModelParameters, PlanningParameters


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
    def task(self) -> NetworkTask:
        """The network, with weights and context neurons."""
        return standard_task(self.model, self.planning, self.seed)


SAMPLER = 'sampler'
"""The row that all others are compared with."""

NETWORK_CONTENDERS: tuple[Contender[NetworkSetting], ...] = (
    Contender(
        SAMPLER, 'srnn, sampler alone',
        'history and random numbers drawn, spikes of all samples', 'compiled_network',
        'CompiledSampler', lambda setting: (setting.task, setting.planning),
    ),
    Contender(
        'planner', 'srnn, whole planning',
        'sampling, decoding, selection and timing of the segment', 'compiled_network',
        'WholePlanning', lambda setting: (setting.model, setting.planning, setting.seed),
    ),
    Contender(
        'numpy', 'NumPy reference', 'history and random numbers drawn, spikes of all samples',
        'numpy_network', 'NumpyNetwork', lambda setting: (setting.task,),
    ),
    Contender(
        'brian2-numpy', 'Brian2, target numpy',
        'no compiler needed; history and code generation not timed', 'brian2_network',
        'Brian2Network', lambda setting: (setting.task, 'numpy'), BRIAN2,
    ),
    Contender(
        'brian2-cython', 'Brian2, target cython', 'history and code generation not timed',
        'brian2_network', 'Brian2Network', lambda setting: (setting.task, 'cython'), BRIAN2,
        ('g++',),
    ),
    Contender(
        'brian2-cpp', 'Brian2, target cpp_standalone',
        'time by its own clock; start of the program, synapses and history not timed',
        'brian2_standalone', 'Brian2Standalone', lambda setting: (setting.task,), BRIAN2,
        ('g++', 'make'),
    ),
    Contender(
        'nest', 'NEST, pp_psc_delta',
        'spike probability 1 - exp(-exp(beta u - c)), without the limit p_max, for which it has '
        'no parameter: more spikes; history and activity of context neurons not timed',
        'nest_network', 'NestNetwork', lambda setting: (setting.task,), NEST,
    ),
)  # fmt: skip
