# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

import pytest

from srnn_bringup.config_files import FILES
from srnn_bringup.parameter_reference import render
from srnn_node.parameters import leaves

PAGE = Path(__file__).parents[3] / 'docs' / 'parameters.md'


def test_the_page_is_what_the_parameter_sets_say():
    """Else run ``python -m srnn_bringup.parameter_reference docs/parameters.md``."""
    assert PAGE.read_text(encoding='utf-8') == render()


@pytest.mark.parametrize('name', FILES)
def test_every_parameter_has_a_row_with_meaning_and_bounds(name):
    rows = [line for line in render().splitlines() if line.startswith('| `')]
    for leaf in leaves(FILES[name]):
        key = leaf.name.rpartition('.')[2]
        (row, *_) = (r for r in rows if r.startswith(f'| `{key}` |') and leaf.spec.doc in r)
        assert leaf.spec.unit in row
        assert leaf.spec.bounds() in row or leaf.spec.bounds() == 'finite' or '`true`' in row \
            or '`false`' in row


def test_every_row_has_five_cells():
    for line in render().splitlines():
        assert not line.startswith('|') or line.count('|') == 6
