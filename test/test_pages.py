# SPDX-License-Identifier: Apache-2.0
"""Whatever a page leads to, or calls by the name of its file, is there."""

import os
from pathlib import Path
import re

from documented import PAGES, ROOT
import pytest

FOLDERS = ('bench', 'config', 'docs', 'examples', 'src', 'test')
NOT_OURS = {'.git', '.venv', 'build', 'install', 'log'}

LINK = re.compile(r'\]\(([^)\s#]*)(?:#([^)\s]*))?\)')
BLOCK = re.compile(r'^```.*?^```$', re.MULTILINE | re.DOTALL)
FILE = re.compile(rf'(?:{"|".join(FOLDERS)})/[\w./-]+\.\w+|[\w./-]+\.(?:py|md)')

every_page = pytest.mark.parametrize(
    'page', PAGES, ids=lambda page: str(page.relative_to(ROOT))
)


def files():
    """Return the paths of all files, relative to the root."""
    for folder, inside, names in os.walk(ROOT):
        inside[:] = [name for name in inside if name not in NOT_OURS]
        yield from (str(Path(folder, name).relative_to(ROOT)) for name in names)


ALL = list(files())


def anchors(page):
    """Return what a link may name of a page: its headings, as forges write them."""
    lines = BLOCK.sub('', page.read_text(encoding='utf-8')).splitlines()
    heads = [line.lstrip('# ').lower() for line in lines if line.startswith('#')]
    return {re.sub(r'[^\w -]', '', head).replace(' ', '-') for head in heads}


@every_page
def test_every_link_leads_somewhere(page):
    for place, anchor in LINK.findall(page.read_text(encoding='utf-8')):
        if re.match('https?://', place):
            continue
        target = (page.parent / place).resolve() if place else page
        assert target.exists(), place
        assert not anchor or anchor in anchors(target), f'{place}#{anchor}'


@every_page
def test_every_file_that_is_named_is_there(page):
    for code in re.findall(r'`([^`\n]+)`', BLOCK.sub('', page.read_text(encoding='utf-8'))):
        for name in FILE.findall(code):
            # Upper case stands for a name that the reader chooses.
            if not re.search(r'\b[A-Z]+\b', name.removesuffix('.md')):
                assert any(f'/{file}'.endswith(f'/{name}') for file in ALL), name
