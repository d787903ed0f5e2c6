# SPDX-License-Identifier: Apache-2.0
"""Where the files of the configuration are."""

import os
from pathlib import Path
import sys

from srnn_bringup.errors import ChoiceError, ConfigDirectoryError
from srnn_config.nearest import did_you_mean

_PLACE = Path('share', 'srnn_bringup', 'config')


def config_directory(module: Path = Path(__file__)) -> Path:
    """Return where the configuration files are.

    In a source tree these are the files that its user edits; else those installed under
    a prefix of ament, or of Python.

    Args:
        module: this file.

    Raises:
        ConfigDirectoryError: they are nowhere; the message lists the places.

    """
    package = module.resolve().parents[1]
    source = [package.parents[1] / 'config'] if (package / 'package.xml').is_file() else []
    ament = [Path(p) for p in os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep) if p]
    places = [*source, *(prefix / _PLACE for prefix in [*ament, Path(sys.prefix)])]
    for place in places:
        if (place / 'network.yaml').is_file():
            return place
    looked = ', '.join(str(place) for place in places)
    raise ConfigDirectoryError(f'no configuration found; looked in {looked}')


def scene_names(directory: Path) -> list[str]:
    """Return the names of the scenes that come with the configuration."""
    return sorted(path.stem for path in (directory / 'scenes').glob('*.yaml'))


def network_names(directory: Path) -> list[str]:
    """Return the names of the networks that come with the configuration."""
    return sorted(path.stem for path in directory.glob('network*.yaml'))


def arm_names(directory: Path) -> list[str]:
    """Return the names of the arm descriptions that come with the configuration."""
    return sorted(path.stem for path in (directory / 'arms').glob('*.yaml'))


def find_arm(choice: str, directory: Path) -> Path:
    """Return the absolute path of an arm description given by name or path.

    Raises:
        ChoiceError: there is no such description; the message lists the names.

    """
    return _find('arm description', choice, directory / 'arms', arm_names(directory))


def find_scene(choice: str, directory: Path) -> Path:
    """Return the absolute path of a scene given by name or path.

    Raises:
        ChoiceError: there is no such scene; the message lists the names.

    """
    return _find('scene', choice, directory / 'scenes', scene_names(directory))


def find_network(choice: str, directory: Path) -> Path:
    """Return the absolute path of a network given by name or path.

    Raises:
        ChoiceError: there is no such network; the message lists the names.

    """
    return _find('network', choice, directory, network_names(directory))


def _find(kind: str, choice: str, directory: Path, names: list[str]) -> Path:
    if choice in names:
        return (directory / f'{choice}.yaml').resolve()
    path = Path(choice)
    if path.is_file():
        return path.resolve()
    hint = did_you_mean(choice, names)
    raise ChoiceError(
        f"no {kind} '{choice}'{hint}; valid: the path of a file, or {', '.join(names)}"
    )
