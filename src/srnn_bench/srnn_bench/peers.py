# SPDX-License-Identifier: Apache-2.0
"""What the planner is compared with, and whether it is installed."""

from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
import sys

NOT_INSTALLED = 'not installed: make peers'

APART = Path(sys.prefix) / 'peers'
"""Where packages lie that need other versions than the environment has, by peer."""


@dataclass(frozen=True)
class Peer:
    """A library that is compared with.

    Attributes:
        name: as people write it.
        distribution: its name among the installed packages.
        shown: distributions whose versions matter for it, its own first.

    """

    name: str
    distribution: str
    shown: tuple[str, ...]

    @property
    def apart(self) -> Path | None:
        """Directory of packages that go before those of the environment; None for none."""
        directory = APART / self.distribution
        return directory if directory.is_dir() else None

    def versions(self) -> dict[str, str]:
        """Return the versions of what is shown, {} if the peer is not installed."""
        versions = {name: self._version(name) for name in self.shown}
        return versions if versions[self.distribution] else {}

    def _version(self, distribution: str) -> str:
        path = [str(self.apart)] if self.apart else []
        found = list(metadata.distributions(name=distribution, path=[*path, *sys.path]))
        return found[0].version if found else ''


BRIAN2 = Peer('Brian2', 'brian2', ('brian2', 'numpy', 'Cython'))
NEST = Peer('NEST', 'nest-simulator', ('nest-simulator',))
OMPL = Peer('OMPL', 'ompl', ('ompl',))

PEERS = (BRIAN2, NEST, OMPL)
