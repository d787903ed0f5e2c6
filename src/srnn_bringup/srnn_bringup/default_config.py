# SPDX-License-Identifier: Apache-2.0
"""The configuration files with every default, written from the parameter sets.

``python -m srnn_bringup.default_config DIRECTORY`` writes them anew after a default,
a bound or a sentence has changed.
"""

from collections.abc import Iterator
import dataclasses
from pathlib import Path
import sys
import textwrap
from typing import Any, get_type_hints

import yaml

from srnn_bringup.config_files import FILES
from srnn_config import Parameters, ParameterSpec
from srnn_config.fields import spec_of

WIDTH = 99


def render(parameters: Parameters) -> str:
    """Return a parameter set as YAML with every key, its meaning, unit and bounds."""
    head = ['# SPDX-License-Identifier: Apache-2.0', *_comment(sentence(type(parameters)), 0)]
    return '\n'.join([*head, *_lines(parameters, 0)]) + '\n'


def write(directory: Path) -> None:
    """Write every configuration file with its defaults."""
    for name, cls in FILES.items():
        (directory / name).parent.mkdir(exist_ok=True)
        (directory / name).write_text(render(cls()), encoding='utf-8')


def _lines(parameters: Parameters, depth: int) -> Iterator[str]:
    hints = get_type_hints(type(parameters))
    for field in dataclasses.fields(parameters):  # type: ignore[arg-type]
        value = getattr(parameters, field.name)
        spec = spec_of(field)
        if spec is None:
            yield ''
            yield from _comment(sentence(hints[field.name]), depth)
            yield f'{"  " * depth}{field.name}:'
            yield from _lines(value, depth + 1)
        else:
            yield from _comment(spec.doc, depth)
            yield from _entry(field.name, value, _notes(spec, value), depth)


def valid(spec: ParameterSpec, value: Any) -> str:
    """Return the bounds of a value in words; nothing where none need to be told."""
    return '' if spec.bounds() == 'finite' or isinstance(value, bool) else spec.bounds()


def _notes(spec: ParameterSpec, value: Any) -> str:
    return ', '.join(note for note in (spec.unit, valid(spec, value)) if note)


def sentence(cls: type) -> str:
    """Return what a parameter set is, as its docstring begins."""
    return ' '.join((cls.__doc__ or '').strip().split('\n\n')[0].split())


def _comment(text: str, depth: int) -> list[str]:
    indent = '  ' * depth + '# '
    return textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=indent)


def _entry(name: str, value: Any, notes: str, depth: int) -> list[str]:
    indent = '  ' * depth
    if isinstance(value, tuple):
        items = f'{name}: [{", ".join(scalar(item) for item in value)}]'
        lines = textwrap.wrap(
            items, WIDTH, initial_indent=indent, subsequent_indent=indent + '  '
        )
    else:
        lines = [f'{indent}{name}: {scalar(value)}']
    if not notes:
        return lines
    if len(lines[-1]) + len(notes) + 4 > WIDTH:
        return [f'{indent}# {notes}', *lines]
    return [*lines[:-1], f'{lines[-1]}  # {notes}']


def scalar(value: Any) -> str:
    """Return one value as YAML writes it."""
    text: str = yaml.safe_dump([value], default_flow_style=True, width=10_000)
    return text.strip()[1:-1]


if __name__ == '__main__':
    write(Path(sys.argv[1]))
