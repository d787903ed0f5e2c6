# SPDX-License-Identifier: Apache-2.0
"""Files that are made to hurt: each is refused by name, at once, and nothing else happens."""

import os

import pytest

from srnn_config import ConfigFileError, read_yaml
from srnn_config.loading import MAX_FILE_BYTES
from srnn_config.plain_yaml import MAX_DEPTH, MAX_SCALAR
from srnn_config.regular_file import read_regular
from srnn_config.scene import load_scene

LAUGHS = 'a: &a [x, x]\n' + ''.join(
    f'{new}: &{new} [*{old}, *{old}, *{old}, *{old}, *{old}, *{old}, *{old}, *{old}]\n'
    for old, new in zip('abcdefgh', 'bcdefghi', strict=True)
)


@pytest.mark.parametrize(
    ('text', 'complaint'),
    [
        (LAUGHS, 'an alias'),
        ('a: &a {b: *a}', 'line 1, column 11: an alias'),
        ('a: ' + '[' * (MAX_DEPTH + 1), f'deeper than {MAX_DEPTH}'),
        ('[' * 900_000, f'deeper than {MAX_DEPTH}'),
        ('a: ' + '9' * (MAX_SCALAR + 1), f'at most {MAX_SCALAR}'),
        ('a: ' + '9:' * 300_000 + '9', f'at most {MAX_SCALAR}'),
        ('a: 2001-13-45', 'not valid YAML'),
        ('a: !!python/object/apply:os.system ["true"]', 'not valid YAML'),
        ('a: 1\n---\nb: 2', 'not valid YAML'),
        ('- 1', 'must hold a mapping'),
        ('', 'must hold a mapping'),
    ],
)
def test_text_that_is_more_than_plain_data_is_refused(tmp_path, text, complaint):
    (tmp_path / 'scene.yaml').write_text(text)
    with pytest.raises(ConfigFileError, match=complaint):
        load_scene(tmp_path / 'scene.yaml')


def test_as_deep_and_as_long_as_allowed_is_read(tmp_path):
    deep = '[' * (MAX_DEPTH - 2) + ']' * (MAX_DEPTH - 2)
    (tmp_path / 'a.yaml').write_text(f'a: {deep}\nb: {"9" * MAX_SCALAR}\n')
    assert read_yaml(tmp_path / 'a.yaml')['b'] == int('9' * MAX_SCALAR)


def test_many_small_branches_are_not_deep(tmp_path):
    (tmp_path / 'a.yaml').write_text(''.join(f'a{n}: [[{n}]]\n' for n in range(3 * MAX_DEPTH)))
    assert len(read_yaml(tmp_path / 'a.yaml')) == 3 * MAX_DEPTH


def test_what_is_no_regular_file_is_refused_without_waiting(tmp_path):
    os.mkfifo(tmp_path / 'pipe.yaml')
    (tmp_path / 'folder.yaml').mkdir()
    for place in (tmp_path / 'pipe.yaml', tmp_path / 'folder.yaml', '/dev/zero'):
        with pytest.raises(ConfigFileError, match='no regular file'):
            read_yaml(place)
    with pytest.raises(ConfigFileError, match='cannot be read'):
        read_yaml('nul\0.yaml')


def test_links_are_followed_only_where_allowed(tmp_path):
    (tmp_path / 'real.yaml').write_text('a: 1')
    (tmp_path / 'link.yaml').symlink_to(tmp_path / 'real.yaml')
    assert read_yaml(tmp_path / 'link.yaml') == {'a': 1}
    with pytest.raises(ConfigFileError, match='is a symbolic link'):
        read_regular(tmp_path / 'link.yaml', 100, follow_links=False)


def test_size_is_looked_at_before_the_content(tmp_path):
    with (tmp_path / 'huge.yaml').open('wb') as file:
        file.truncate(1 << 40)
    with pytest.raises(ConfigFileError, match=f'larger than {MAX_FILE_BYTES}'):
        read_yaml(tmp_path / 'huge.yaml')
