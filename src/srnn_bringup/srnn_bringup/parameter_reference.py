# SPDX-License-Identifier: Apache-2.0
"""The reference of all parameters as a page, written from the parameter sets.

``python -m srnn_bringup.parameter_reference FILE`` writes it anew.
"""

from collections.abc import Iterator
import dataclasses
from pathlib import Path
import sys
from typing import Any, get_type_hints

from srnn_bringup.config_files import FILES
from srnn_bringup.default_config import scalar, sentence, valid
from srnn_config import Parameters
from srnn_config.fields import spec_of
from srnn_config.scene import SceneNoise, SceneTask

_HEAD = """\
# Parameters

Everything a user may set, by file of `config/`. An unknown key, a value of the wrong type or
beyond its bounds is refused before anything moves; the message names the key, the value and what
is valid. Nodes show the same names, units and bounds as ROS parameters (`ros2 param describe`).
This page is written by `python -m srnn_bringup.parameter_reference docs/parameters.md`; a test
fails when it is out of date.
"""

_SCENE = """\
## Scene files

`config/scenes/NAME.yaml`, or any path. Beside the keys below: `waypoints`, a list of `[x, y]`;
`start`, `[x, y]`, the first way point unless given; `obstacles`, a list of mappings with `shape`
(`box` with `size` and `yaw`, `disc` with `radius`, `polygon` with convex `points` and `yaw`),
`center`, and if wanted `appears_at` and `disappears_at`, numbers of segments, and `known`, whether
the planner is told of it. Metres and radians, within 0.3 m of the centre of the plane.
"""

_ROW = '| key | default | unit | valid | meaning |\n|---|---|---|---|---|'


def render() -> str:
    """Return the page in Markdown."""
    lines = [_HEAD]
    for name, cls in FILES.items():
        lines += [f'## {name}', '', sentence(cls), '', *_set(cls, '')]
    scene = [*_table(SceneTask), '', '### noise', '', sentence(SceneNoise), '']
    return '\n'.join([*lines, _SCENE, *scene, *_table(SceneNoise)]) + '\n'


def _set(cls: type[Parameters], prefix: str) -> Iterator[str]:
    """Yield the table of a parameter set, then those of the sets within."""
    table = list(_table(cls))
    if table:
        yield from (*table, '')
    hints = get_type_hints(cls)
    for field in dataclasses.fields(cls):  # type: ignore[arg-type]
        if spec_of(field) is None:
            name = f'{prefix}{field.name}'
            yield from (f'### {name}', '', sentence(hints[field.name]), '')
            yield from _set(hints[field.name], f'{name}.')


def _table(cls: type[Parameters]) -> Iterator[str]:
    fields = [
        (field, spec) for field in dataclasses.fields(cls)  # type: ignore[arg-type]
        if (spec := spec_of(field)) is not None
    ]  # fmt: skip
    if not fields:
        return
    yield _ROW
    for field, spec in fields:
        value = field.default
        default = 'required' if value is dataclasses.MISSING else f'`{_text(value)}`'
        yield f'| `{field.name}` | {default} | {spec.unit} | {valid(spec, value)} | {spec.doc} |'


def _text(value: Any) -> str:
    if isinstance(value, tuple):
        return f'[{", ".join(map(scalar, value))}]'
    return scalar(value)


if __name__ == '__main__':
    Path(sys.argv[1]).write_text(render(), encoding='utf-8')
