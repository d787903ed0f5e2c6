# SPDX-License-Identifier: Apache-2.0
"""Weights by name: a weight file, or a version of those that a bag has."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from srnn_bag import open_bag
from srnn_bringup.config import NETWORK, Choices, load
from srnn_bringup.errors import ChoiceError
from srnn_msgs_py.ros import weights
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core import weights_file
from srnn_planner.core.parameters import ModelParameters
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses
from srnn_replay.origin import RunOrigin
from srnn_replay.recording import decode

TOPIC = 'weights'
AT = '@'


@dataclass(frozen=True, eq=False)
class Version:
    """A version of the weights and when it was shared [ns of system time], 0 if unknown."""

    weights: WeightsUpdate
    shared_ns: int = 0


@dataclass(frozen=True, eq=False)
class Belief:
    """All versions that a source has, oldest first, and the network that they are of."""

    name: str
    model: ModelParameters
    versions: tuple[Version, ...]

    @cached_property
    def neurons(self) -> StateNeurons:
        """Return the neurons."""
        return StateNeurons(self.model.network)

    @property
    def metres(self) -> NDArray[np.float64]:
        """Return where the neurons are (K, d) [m]."""
        return np.asarray(self.model.workspace.to_metres(self.neurons.positions))

    @property
    def prior(self) -> Version:
        """Return the version before anything was learned."""
        return Version(WeightsUpdate(0, 0, Synapses(self.neurons.prior).learned))

    def synapses(self, version: Version) -> Synapses:
        """Return the weights of a version.

        Raises:
            WeightsError: they are of another network.

        """
        return self.neurons.synapses(version.weights.learned)

    def version(self, number: int | None) -> Version:
        """Return a version, the newest if None.

        Raises:
            ChoiceError: there is no such version; the message lists those there are.

        """
        if number is None:
            return self.versions[-1]
        found = [v for v in self.versions if v.weights.version == number]
        if not found:
            known = ', '.join(str(v.weights.version) for v in self.versions)
            raise ChoiceError(f'{self.name}: has no version {number}; versions: {known}')
        return found[-1]

    def before(self, version: Version) -> Version:
        """Return the version before another, the prior before the first."""
        index = self.versions.index(version)
        if index:
            return self.versions[index - 1]
        return self.prior


def read(source: str) -> tuple[Belief, Version]:
    """Return what a source has, and the version that is meant.

    Args:
        source: path of a weight file or a bag; ``@N`` behind it for version N.

    Raises:
        ChoiceError: it has no such version, or no weights at all.
        BagError: it is a damaged bag.
        SrnnError: it is no weight file.

    """
    path, number = _split(source)
    if not path.exists():
        raise ChoiceError(f'{path}: there is no such bag or weight file')
    belief = _of_bag(path) if path.is_dir() or path.suffix == '.mcap' else _of_file(path)
    return belief, belief.version(number)


def _split(source: str) -> tuple[Path, int | None]:
    name, at, number = source.rpartition(AT)
    if not at or Path(source).exists():
        return Path(source), None
    if not number.isdecimal():
        raise ChoiceError(f'{source}: behind {AT} must be the number of a version')
    return Path(name), int(number)


def _of_file(path: Path) -> Belief:
    update = weights_file.load(path)
    model = load(Choices(network=NETWORK)).network.model
    StateNeurons(model.network).synapses(update.learned)
    return Belief(str(path), model, (Version(update),))


def _of_bag(path: Path) -> Belief:
    bag = open_bag(path)
    names = sorted(name for name in bag.topics if name.rpartition('/')[2] == TOPIC)
    model = RunOrigin(bag).adapter().model
    found = decode(TOPIC, bag.messages(set(names[:1])), weights.from_msg)
    versions: dict[int, Version] = {}
    for one in found:
        versions.setdefault(one.value.version, Version(one.value, one.message.sent_ns))
    if not versions:
        raise ChoiceError(f'{path}: has no weights')
    return Belief(str(path), model, tuple(versions[n] for n in sorted(versions)))
