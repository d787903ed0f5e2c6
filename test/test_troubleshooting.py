# SPDX-License-Identifier: Apache-2.0
"""Pages quote what the program says, and name functions where they are."""

import ast
from functools import cache
from pathlib import Path
import re

import pytest

ROOT = Path(__file__).parents[1]
PAGE = ROOT / 'docs' / 'troubleshooting.md'
CONCEPTS = ROOT / 'docs' / 'concepts.md'


@cache
def said():
    """Return every piece of text in the sources, and what make says."""
    pieces = {(ROOT / 'Makefile').read_text()}
    for file in (ROOT / 'src').glob('*/*/**/*.py'):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                pieces.add(node.value)
    return '\n'.join(pieces)


def symptoms():
    for line in PAGE.read_text(encoding='utf-8').splitlines():
        if line.startswith('| ') and not line.startswith('| what you see'):
            yield from re.findall(r'`([^`]+)`', line.split(' | ')[0])


def test_the_page_quotes_the_program():
    quoted = [piece.strip() for symptom in symptoms() for piece in symptom.split('...')]
    assert len(quoted) > 30
    for piece in filter(None, quoted):
        assert piece in said(), piece


def test_every_cause_that_stops_the_arm_until_reset_is_explained():
    faults = (ROOT / 'docs' / 'faults.md').read_text(encoding='utf-8')
    explained = PAGE.read_text(encoding='utf-8') + faults
    from lwr_tracking.core.failsafe import RULES

    for rule in RULES.values():
        assert rule.cause in explained


@pytest.mark.parametrize(
    ('names', 'file'),
    re.findall(
        r'\[((?:`[^`]+`(?:, )?)+)\]\(\.\./(src/[^)]+\.py)\)', CONCEPTS.read_text(encoding='utf-8')
    ),
)
def test_concepts_link_functions_to_the_file_that_has_them(names, file):
    tree = ast.parse((ROOT / file).read_text())
    defined = {node.name for node in ast.walk(tree) if hasattr(node, 'name')}
    for name in re.findall(r'`([^`]+)`', names):
        assert set(filter(None, name.split('.'))) <= defined, f'{name} in {file}'
