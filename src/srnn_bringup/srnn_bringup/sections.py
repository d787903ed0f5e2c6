# SPDX-License-Identifier: Apache-2.0
"""In which section of the help an option stands, the same in every command."""

from collections.abc import Mapping, Sequence

SECTIONS: Mapping[str, tuple[str, ...]] = {
    'what runs': (
        '--arm', '--arm-description', '--emulator', '--scene', '--target', '--world', '--agent',
        '--network', '--seed', '--segments', '--trials', '--scenes', '--first', '--long',
        '--repeats', '--only',
    ),
    'what is learned': ('--signal', '--alpha', '--weights', '--set'),
    'the graph and others': (
        '--peer', '--namespace', '--remap', '--key', '--secure', '--publish', '--topic', '--rate',
    ),
    'where it is done': ('--workers', '--scheduler'),
    'what is written and shown': (
        '--out', '--json', '--picture', '--save-weights', '--record', '--view', '--quiet',
    ),
}  # fmt: skip
"""The options of each section, by its title; what is in none stands under `options`."""

EXECUTION = 'where it is done'

_TITLES = {name: title for title, names in SECTIONS.items() for name in names}


def section_of(names: Sequence[str]) -> str | None:
    """Return the title of the section of an option, None for any other argument."""
    return next((_TITLES[name] for name in names if name in _TITLES), None)
