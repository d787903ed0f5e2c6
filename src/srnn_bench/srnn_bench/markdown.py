# SPDX-License-Identifier: Apache-2.0
"""Tables and lists in Markdown."""

from collections.abc import Mapping, Sequence


def table(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table of cells, row by row."""
    lines = [columns, ['---'] * len(columns), *rows]
    return '\n'.join(f'| {" | ".join(_escaped(cell) for cell in line)} |' for line in lines)


def listing(items: Mapping[str, str]) -> str:
    """Return one line for each item."""
    return '\n'.join(f'- {name}: {text}' for name, text in items.items())


def _escaped(cell: str) -> str:
    return ' '.join(cell.replace('|', r'\|').split())
