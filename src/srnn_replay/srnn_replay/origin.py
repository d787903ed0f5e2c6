# SPDX-License-Identifier: Apache-2.0
"""What the nodes of a recorded run were told, out of the files in the bag."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
import json
from pathlib import Path
import tempfile
from typing import Any, TypeVar

from lwr_tracking.node_parameters import TrackerNodeParameters
from srnn_bag import Bag
from srnn_bag.attached import PARAMETERS, RUN, SCENE, START_WEIGHTS
from srnn_config import ConfigError, Parameters, build
from srnn_config.plain_yaml import parse
from srnn_config.scene import build_scene
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core import weights_file
from srnn_planner.core.planning_session import Origin
from srnn_planner.nodes.adapter_parameters import AdapterParameters
from srnn_planner.nodes.planner_parameters import PlannerParameters
from srnn_replay.code_version import code_version
from srnn_replay.errors import NotReplayableError, OtherVersionError

P = TypeVar('P', bound=Parameters)

NUMBERS = ('code', 'numpy', 'numba', 'llvmlite', 'mujoco')
"""Versions that must be the same for decisions to be the same."""


@dataclass(frozen=True)
class RunOrigin:
    """The beginnings of a run, as its bag tells them, or somebody who knows.

    Attributes:
        bag: the recording.
        told: files that the bag would have attached, had `srnn` recorded it, by name.

    """

    bag: Bag
    told: Mapping[str, bytes] = field(default_factory=dict)

    def check_version(self) -> str:
        """Return what may make the last bit of a number another one here, in words.

        Raises:
            OtherVersionError: other code or other libraries have made the decisions.

        """
        if RUN not in self.bag.attachments:
            return 'recorded by an unknown version'
        then, now = self._run().get('versions', {}), code_version()
        other = [name for name in NUMBERS if then.get(name) != now[name]]
        if other:
            commit = f' (commit {then["commit"]})' if then.get('commit') else ''
            differences = ', '.join(f'{n} {then.get(n, "unknown")}, here {now[n]}' for n in other)
            raise OtherVersionError(
                f'{self.bag.path}: recorded by another version{commit}: {differences}'
            )
        same = [then.get(name) == now[name] for name in ('machine', 'python')]
        where = f'recorded on {then.get("machine")}, Python {then.get("python")}'
        return '' if all(same) else where

    def tracker(self) -> TrackerNodeParameters:
        """Return what the tracker was told."""
        return self._parameters('tracker', TrackerNodeParameters)

    def adapter(self) -> AdapterParameters:
        """Return what the adapter was told."""
        return self._parameters('adapter', AdapterParameters)

    def planner(self) -> Origin:
        """Return what the planner began from."""
        told = self._parameters('planner', PlannerParameters)
        where = f'{self.bag.path}: {SCENE}'
        scene = build_scene(_mapping(self._file(SCENE), where), where)
        return Origin(scene, told.model, told.planning, told.seed)

    def start_weights(self) -> WeightsUpdate | None:
        """Return the weights that learning began from, None for the prior."""
        if not self.adapter().initial_weights:
            return None
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, START_WEIGHTS)
            file.write_bytes(self._file(START_WEIGHTS))
            return weights_file.load(file)

    def _run(self) -> dict[str, Any]:
        try:
            return dict(json.loads(self._file(RUN)))
        except (TypeError, ValueError):
            raise NotReplayableError(f'{self.bag.path}: {RUN} in it is damaged') from None

    def _parameters(self, node: str, cls: type[P]) -> P:
        name = PARAMETERS.format(node)
        where = f'{self.bag.path}: {name}'
        try:
            told = _mapping(self._file(name), where)['/**']['ros__parameters']
            # Every node also has parameters that decide nothing, for example how it starts.
            known = {f.name for f in fields(cls)}  # type: ignore[arg-type]
            return build(cls, {key: told[key] for key in told if key in known}, where)
        except (ConfigError, KeyError, TypeError) as error:
            raise NotReplayableError(f'{where}: {error}') from error

    def _file(self, name: str) -> bytes:
        content = self.bag.attachments.get(name, self.told.get(name))
        if content is None:
            raise NotReplayableError(
                f'{self.bag.path}: has no {name} attached: record with `srnn record` or --record, '
                'or say by --scene how the graph was started'
            )
        return content


def _mapping(content: bytes, where: str) -> Mapping[str, Any]:
    data = parse(content.decode('utf-8', 'replace'), where)
    if not isinstance(data, Mapping):
        raise NotReplayableError(f'{where}: is no mapping')
    return data
