# SPDX-License-Identifier: Apache-2.0
"""Pieces of a page; whatever comes from a run is escaped."""

import base64
from collections.abc import Iterable, Sequence
from html import escape
from importlib.resources import files
import json
from pathlib import Path
from typing import Any

_PLACE = files('srnn_bringup.page')


def page(title: str, parts: Iterable[str]) -> str:
    """Return a whole document that needs no other file."""
    style = (_PLACE / 'page.css').read_text(encoding='utf-8')
    body = '\n'.join(parts)
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<title>{escape(title)}</title>\n<style>\n{style}</style>\n</head>\n'
        f'<body>\n<h1>{escape(title)}</h1>\n{body}\n</body>\n</html>\n'
    )


def section(heading: str, *parts: str) -> str:
    """Return a section with a heading."""
    return f'<h2>{escape(heading)}</h2>\n' + '\n'.join(part for part in parts if part)


def paragraph(text: str) -> str:
    """Return a paragraph."""
    return f'<p>{escape(text)}</p>'


def cards(figures: Iterable[tuple[str, str]]) -> str:
    """Return figures with what they are of."""
    items = (
        f'<div class="card"><b>{escape(value)}</b><span>{escape(name)}</span></div>'
        for name, value in figures
    )
    return f'<div class="cards">{"".join(items)}</div>'


def table(
    heading: Sequence[str], rows: Iterable[Sequence[str]], numbers: int = 0,
    classes: Sequence[str] = (),
) -> str:
    """Return a table; the last `numbers` columns are figures."""
    first = len(heading) - numbers

    def cells(kind: str, row: Sequence[str]) -> str:
        parts = []
        for index, cell in enumerate(row):
            figure = ' class="n"' if index >= first else ''
            parts.append(f'<{kind}{figure}>{escape(cell)}</{kind}>')
        return ''.join(parts)

    body = []
    for index, row in enumerate(rows):
        name = f' class="{escape(classes[index])}"' if index < len(classes) else ''
        body.append(f'<tr{name}>{cells("td", row)}</tr>')
    kind = ' class="figures"' if numbers else ''
    return (
        f'<div class="scroll"><table{kind}><thead><tr>{cells("th", heading)}</tr></thead>'
        f'<tbody>{"".join(body)}</tbody></table></div>'
    )


def picture(file: Path, words: str) -> str:
    """Return a picture, with its data, and what it shows."""
    data = base64.b64encode(file.read_bytes()).decode()
    source = f'data:image/png;base64,{data}'
    return (
        f'<figure><img src="{source}" alt="{escape(words)}">'
        f'<figcaption>{escape(words)}</figcaption></figure>'
    )


def script(name: str, **data: Any) -> str:
    """Return a script of this package, and the data that it wants as constants."""
    # No text of a run may end the script.
    constants = ''.join(
        f'const {key} = {json.dumps(value, separators=(",", ":"))};\n'.replace('<', '\\u003c')
        for key, value in data.items()
    )
    return f'<script>\n{constants}{(_PLACE / name).read_text(encoding="utf-8")}</script>'
