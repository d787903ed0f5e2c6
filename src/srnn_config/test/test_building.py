# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, field

from hypothesis import given
from hypothesis import strategies as st
import pytest
import yaml

from srnn_config import (
    ConfigFileError,
    ParameterError,
    Parameters,
    UnknownKeyError,
    build,
    parameter,
    read_yaml,
    to_mapping,
)
from srnn_config.loading import MAX_FILE_BYTES


@dataclass(frozen=True)
class Leaf(Parameters):
    """Innermost set."""

    width: float = parameter(1.0, above=0.0, unit='m', doc='Width.')
    tags: tuple[str, ...] = parameter((), doc='Tags.')


@dataclass(frozen=True)
class Branch(Parameters):
    """Set in the middle."""

    count: int = parameter(1, minimum=1, doc='Count.')
    leaf: Leaf = field(default_factory=Leaf)


@dataclass(frozen=True)
class Tree(Parameters):
    """Outermost set, with one required field."""

    name: str = parameter(doc='Name.')
    fast: bool = parameter(True, doc='Fast.')
    branch: Branch = field(default_factory=Branch)


TREES = st.builds(
    Tree,
    name=st.text(),
    fast=st.booleans(),
    branch=st.builds(
        Branch,
        count=st.integers(1, 10**9),
        leaf=st.builds(
            Leaf,
            width=st.floats(0.0, exclude_min=True, allow_infinity=False),
            tags=st.lists(st.text(), max_size=4),
        ),
    ),
)


@given(TREES)
def test_a_set_survives_the_way_through_plain_data(tree):
    assert build(Tree, to_mapping(tree), 'test') == tree


@given(TREES)
def test_plain_data_survives_the_way_through_yaml(tree):
    text = yaml.safe_dump(to_mapping(tree), allow_unicode=False)
    assert build(Tree, yaml.safe_load(text), 'test') == tree


def test_what_is_left_out_keeps_its_default():
    tree = build(Tree, {'name': 'oak', 'branch': {'leaf': {'width': 2}}}, 'test')
    assert tree == Tree('oak', True, Branch(1, Leaf(2.0)))


@pytest.mark.parametrize(
    ('data', 'complaint'),
    [
        ({'nam': 'oak'}, "file: unknown key 'nam' (did you mean 'name'?); valid keys: name, fast"),
        ({'name': 'oak', 7: 1}, "file: unknown key '7'; valid keys: name, fast, branch"),
        (
            {'name': 'oak', 'branch': {'leaf': {'colour': 1}}},
            "file.branch.leaf: unknown key 'colour'; valid keys: width, tags",
        ),
    ],
)
def test_unknown_keys_are_refused_with_the_place_and_the_valid_ones(data, complaint):
    with pytest.raises(UnknownKeyError) as caught:
        build(Tree, data, 'file')
    assert complaint in str(caught.value)
    assert isinstance(caught.value, ValueError)


@given(st.text().filter(lambda key: key not in ('width', 'tags')))
def test_no_unknown_key_slips_through(key):
    with pytest.raises(UnknownKeyError, match='valid keys: width, tags'):
        build(Leaf, {key: 1.0}, 'file')


@pytest.mark.parametrize(
    ('data', 'complaint'),
    [
        ({}, 'file: missing name'),
        ({'name': 'oak', 'branch': 3}, 'file.branch: must be a mapping of keys to values, not 3'),
        ({'name': 'oak', 'branch': None}, 'file.branch: must be a mapping'),
        (
            {'name': 'oak', 'branch': {'leaf': {'width': 0}}},
            'file.branch.leaf: Leaf.width = 0.0: must be > 0 [m]',
        ),
        (['name'], "file: must be a mapping of keys to values, not ['name']"),
    ],
)
def test_impossible_data_are_refused_with_their_place(data, complaint):
    with pytest.raises(ParameterError) as caught:
        build(Tree, data, 'file')
    assert complaint in str(caught.value)


def test_a_yaml_mapping_is_read(tmp_path):
    file = tmp_path / 'tree.yaml'
    file.write_text('name: oak\nbranch: {count: 2}\n')
    assert read_yaml(file) == {'name': 'oak', 'branch': {'count': 2}}


@pytest.mark.parametrize(
    ('content', 'complaint'),
    [
        (b'name: [', 'not valid YAML: line 1, column 8: '),
        (b'- a\n- b\n', 'must hold a mapping'),
        (b'', 'must hold a mapping'),
        (b'name: \xff\xfe', 'cannot be read'),
        (b'# ' + b'x' * MAX_FILE_BYTES, 'larger than'),
        (b'name: !!python/object/apply:os.getcwd []', 'not valid YAML'),
    ],
)
def test_bad_files_are_refused_by_name(tmp_path, content, complaint):
    file = tmp_path / 'bad.yaml'
    file.write_bytes(content)
    with pytest.raises(ConfigFileError) as caught:
        read_yaml(file)
    assert str(file) in str(caught.value)
    assert complaint in str(caught.value)


def test_a_missing_file_is_refused_by_name(tmp_path):
    with pytest.raises(ConfigFileError, match=r'nowhere\.yaml: cannot be read') as caught:
        read_yaml(tmp_path / 'nowhere.yaml')
    assert isinstance(caught.value, OSError)
