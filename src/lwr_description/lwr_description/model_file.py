# SPDX-License-Identifier: Apache-2.0
"""Where the model file of an arm lies."""

from importlib.util import find_spec
from pathlib import Path

from lwr_description.errors import MissingModelError


def find_model(model: str) -> Path:
    """Return the path of a model file; the package that holds it is not imported.

    Args:
        model: absolute path, or PACKAGE:PATH in an installed Python package.

    Raises:
        MissingModelError: there is no such package or file.

    """
    package, colon, inside = model.partition(':')
    if not colon:
        path = Path(model)
        if not path.is_absolute():
            raise MissingModelError(f'model = {model!r}: must be an absolute path or PACKAGE:PATH')
        return _existing(model, [path])
    try:
        spec = find_spec(package)
    except (ImportError, ValueError):
        spec = None
    if spec is None or spec.submodule_search_locations is None:
        raise MissingModelError(
            f'model = {model!r}: there is no Python package {package!r}; install it'
        )
    return _existing(model, [Path(place) / inside for place in spec.submodule_search_locations])


def _existing(model: str, places: list[Path]) -> Path:
    for place in places:
        if place.is_file():
            return place
    raise MissingModelError(
        f'model = {model!r}: there is no such file: {", ".join(map(str, places))}'
    )
