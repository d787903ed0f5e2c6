# SPDX-License-Identifier: Apache-2.0
"""The Markdown that experiments write, as HTML: headings, pictures, lists, tables, paragraphs."""

from collections.abc import Iterator
from html import escape
from itertools import groupby
from pathlib import Path
import re

from srnn_bringup.page import html

_HEADING = re.compile(r'(#+) +(.*)')
_PICTURE = re.compile(r'!\[(.*?)\]\((.*?)\)$')
_LINK = re.compile(r'\[(.*?)\]\((.*?)\)')
_CODE, _BOLD = re.compile(r'`(.*?)`'), re.compile(r'\*\*(.*?)\*\*')
_RULE = re.compile(r'[|\s:-]+$')
_STARTS = {'#': 'heading', '|': 'table', '* ': 'list', '- ': 'list', '![': 'picture'}


def from_markdown(text: str, directory: Path) -> Iterator[str]:
    """Yield the blocks of a text as HTML; pictures are looked for in a directory."""
    for kind, lines in groupby(text.splitlines(), _kind):
        block = list(lines)
        if kind == 'heading':
            yield from (_heading(line) for line in block)
        elif kind == 'table':
            yield _table(block)
        elif kind == 'list':
            items = ''.join(f'<li>{inline(line.lstrip("*- "))}</li>' for line in block)
            yield f'<ul>{items}</ul>'
        elif kind == 'picture':
            yield from (_picture(line, directory) for line in block)
        elif kind == 'text':
            yield f'<p>{inline(" ".join(block))}</p>'


def inline(text: str) -> str:
    """Return a line as HTML; links to files beside the page keep their words only."""
    text = _LINK.sub(r'\1', escape(text, quote=False))
    return _BOLD.sub(r'<b>\1</b>', _CODE.sub(r'<code>\1</code>', text))


def _kind(line: str) -> str:
    if not line.strip():
        return ''
    return next((kind for start, kind in _STARTS.items() if line.startswith(start)), 'text')


def _heading(line: str) -> str:
    match = _HEADING.match(line)
    assert match is not None
    return f'<h2>{inline(match[2])}</h2>'


def _picture(line: str, directory: Path) -> str:
    match = _PICTURE.match(line.strip())
    if match is None or not (directory / Path(match[2]).name).is_file():
        return f'<p>{inline(line)}</p>'
    return html.picture(directory / Path(match[2]).name, match[1])


def _table(block: list[str]) -> str:
    heading, *rows = ([cell.strip() for cell in line.strip('| ').split('|')] for line in block)
    kept = [row for row, line in zip(rows, block[1:], strict=True) if not _RULE.match(line)]

    def cells(kind: str, row: list[str]) -> str:
        return ''.join(f'<{kind}>{inline(cell)}</{kind}>' for cell in row)

    body = ''.join(f'<tr>{cells("td", row)}</tr>' for row in kept)
    return (
        f'<div class="scroll"><table><thead><tr>{cells("th", heading)}</tr></thead>'
        f'<tbody>{body}</tbody></table></div>'
    )
