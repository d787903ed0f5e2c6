# SPDX-License-Identifier: Apache-2.0
"""Docstrings speak of arguments and attributes that are there: `make docs` prints them."""

import ast
from pathlib import Path
import re

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = sorted(file.parent.name for file in ROOT.glob('src/*/package.xml'))


def entries(docstring, heading):
    """Return the names that a section of a docstring explains."""
    _, found, rest = (docstring or '').partition(f'{heading}:\n')
    section = re.split(r'\n\S', rest)[0] if found else ''
    return set(re.findall(r'^    \*{0,2}(\w+)(?: \([^)]*\))?:', section, re.MULTILINE))


def arguments(function):
    named = function.args
    several = (named.vararg, named.kwarg)
    every = [*named.posonlyargs, *named.args, *named.kwonlyargs, *filter(None, several)]
    return {argument.arg for argument in every}


def attributes(cls):
    """Return what a class defines, or assigns to itself."""
    names = {node.name for node in cls.body if isinstance(node, ast.FunctionDef)}
    for node in ast.walk(cls):
        target = node.target if isinstance(node, ast.AnnAssign) else node
        if isinstance(target, ast.Attribute):
            names.add(target.attr)
        elif isinstance(target, ast.Name):
            names.add(target.id)
    return names


@pytest.mark.parametrize('package', PACKAGES)
def test_what_is_explained_exists(package):
    for file in sorted((ROOT / 'src' / package / package).rglob('*.py')):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.FunctionDef):
                extra = entries(ast.get_docstring(node), 'Args') - arguments(node)
                assert not extra, f'{file}: {node.name}'
            elif isinstance(node, ast.ClassDef):
                extra = entries(ast.get_docstring(node), 'Attributes') - attributes(node)
                assert not extra, f'{file}: {node.name}'


def test_a_wrong_name_would_be_found():
    (function,) = ast.parse(
        'def f(a):\n    """F.\n\n    Args:\n        b: nothing.\n\n    """\n'
    ).body
    assert entries(ast.get_docstring(function), 'Args') - arguments(function) == {'b'}
