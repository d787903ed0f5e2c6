# SPDX-License-Identifier: Apache-2.0
"""What a package imports is what it declares, to rosdep and to pip."""

import ast
from pathlib import Path
import re
import sys
from xml.etree import ElementTree

import pytest
import yaml

ROOT = Path(__file__).parents[1]
SRC = ROOT / 'src'
PACKAGES = sorted(path.parent.name for path in SRC.glob('*/package.xml'))

ROSDEP_KEYS = {
    'cryptography': 'python3-cryptography',
    'hypothesis': 'python3-hypothesis',
    'llvmlite': 'python3-llvmlite',
    'lz4': 'python3-lz4',
    'matplotlib': 'python3-matplotlib',
    'mcap': 'python3-mcap-pip',
    'mcap_ros2': 'python3-mcap-ros2-support-pip',
    'mujoco': 'python3-mujoco-pip',
    'numba': 'python3-numba',
    'numpy': 'python3-numpy',
    'pytest': 'python3-pytest',
    'rosbags': 'python3-rosbags-pip',
    'shtab': 'python3-shtab',
    'threadpoolctl': 'python3-threadpoolctl',
    'tqdm': 'python3-tqdm',
    'trimesh': 'python3-trimesh-pip',
    'viser': 'python3-viser-pip',
    'yaml': 'python3-yaml',
    'zstandard': 'python3-zstandard',
}
"""The rosdep key of every imported module that no ROS package has."""

PIP_NAMES = {'yaml': 'PyYAML', 'mcap_ros2': 'mcap-ros2-support'}
"""Where the name for pip is not that of the module."""

OPTIONAL = {'brian2', 'distributed', 'nest', 'ompl'}
"""What is compared with, or farmed out to, if it is there."""

packages = pytest.mark.parametrize('package', PACKAGES)


def imported(*folders):
    """Return the modules that files import, but for the standard library."""
    found = set()
    for file in (file for folder in folders for file in folder.rglob('*.py')):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.Import):
                found.update(alias.name.partition('.')[0] for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and node.module:
                found.add(node.module.partition('.')[0])
    return found - sys.stdlib_module_names - OPTIONAL


def at_work(package):
    return imported(SRC / package / package, SRC / package / 'launch') - {package}


def in_tests(package):
    tests = SRC / package / 'test'
    # A runner is needed even where no test imports it.
    return imported(tests) - {package, *(file.stem for file in tests.rglob('*.py'))} | {'pytest'}


def keys(modules):
    """Return what rosdep calls them; a ROS package is called as its module is."""
    return {ROSDEP_KEYS.get(module, module) for module in modules}


def declared(package, kind):
    root = ElementTree.parse(SRC / package / 'package.xml').getroot()
    return {item.text for item in root.findall(kind)}


def foreign(names):
    return {name for name in names if name.startswith('python3-')}


@packages
def test_rosdep_installs_all_that_a_package_imports(package):
    needs = keys(at_work(package))
    assert needs <= declared(package, 'exec_depend')
    # Types of messages are named in the table of topics, and imported from there.
    assert foreign(declared(package, 'exec_depend')) == foreign(needs)


@packages
def test_rosdep_installs_all_that_the_tests_of_a_package_import(package):
    lacking = keys(in_tests(package)) - declared(package, 'exec_depend')
    assert lacking <= declared(package, 'test_depend')
    assert foreign(declared(package, 'test_depend')) == foreign(lacking)


@packages
def test_pip_installs_all_that_a_package_imports(package):
    text = (SRC / package / 'setup.py').read_text()
    (requires,) = re.findall(r'install_requires=\[(.*?)\]', text, re.DOTALL)
    names = set(re.findall(r"'([\w-]+)", requires))
    modules = at_work(package) & ROSDEP_KEYS.keys()
    assert {PIP_NAMES.get(module, module) for module in modules} <= names


def test_keys_of_our_own_are_used():
    own = yaml.safe_load((ROOT / 'rosdep.yaml').read_text())
    assert set(own) <= set(ROSDEP_KEYS.values())
    assert all({'debian', 'ubuntu'} == set(systems) for systems in own.values())
