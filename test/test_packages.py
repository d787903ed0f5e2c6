# SPDX-License-Identifier: Apache-2.0
"""What holds for every package of the workspace: build files, size, direction of imports."""

import ast
from configparser import ConfigParser
from functools import cache
from pathlib import Path
import re
import subprocess
import sys
from xml.etree import ElementTree

import pytest

ROOT = Path(__file__).parents[1]
SRC = ROOT / 'src'
MAX_LINES = 300
MAX_NODE_LINES = 160

# What a package may import of the workspace: whatever stands above it, except where noted.
ORDER = (
    'srnn_config', 'srnn_access', 'srnn_msgs_py', 'srnn_node', 'lwr_description', 'lwr_guard',
    'srnn_planner', 'lwr_tracking', 'lwr_sim_bridge', 'lwr_fri_driver', 'srnn_bag',
    'srnn_replay', 'srnn_experiments', 'srnn_bench', 'srnn_view', 'srnn_bringup',
)  # fmt: skip
STRANGERS = {
    'srnn_access': {'srnn_config'},
    'srnn_msgs_py': {'srnn_config'},
    'srnn_planner': {'lwr_description', 'lwr_guard'},
    'lwr_tracking': {'srnn_planner', 'lwr_guard'},
    'lwr_sim_bridge': {'srnn_planner', 'lwr_tracking'},
    'lwr_fri_driver': {'srnn_planner', 'lwr_tracking', 'lwr_sim_bridge'},
    'lwr_description': {'srnn_msgs_py', 'srnn_node'},
    'lwr_guard': {'srnn_msgs_py', 'srnn_node'},
    'srnn_bag': set(ORDER) - {'srnn_msgs_py'},
    'srnn_replay': {'lwr_guard', 'lwr_fri_driver', 'lwr_sim_bridge'},
    'srnn_view': set(ORDER) - {
        'srnn_config', 'srnn_msgs_py', 'srnn_node', 'lwr_description', 'lwr_sim_bridge',
    },
    'srnn_experiments': {'srnn_node', 'lwr_fri_driver', 'srnn_bag', 'srnn_replay'},
    'srnn_bench': set(ORDER) - {
        'srnn_config', 'lwr_description', 'srnn_planner', 'srnn_experiments',
    },
}
EXECUTABLES = {
    'srnn_planner': {
        'planner': 'srnn_planner.nodes.planner_node:main',
        'adapter': 'srnn_planner.nodes.adapter_node:main',
    },
    'lwr_tracking': {'tracker': 'lwr_tracking.tracker_node:main'},
    'lwr_sim_bridge': {
        'sim_bridge': 'lwr_sim_bridge.bridge_node:main',
        'mock_arm': 'lwr_sim_bridge.mock_arm_node:main',
        'fri_emulator': 'lwr_sim_bridge.fri.emulator_node:main',
    },
    'lwr_fri_driver': {'fri_driver': 'lwr_fri_driver.driver_node:main'},
    'srnn_view': {'view': 'srnn_view.view_node:main'},
    'srnn_bringup': {'srnn': 'srnn_bringup.cli:main'},
}
# Packages, or parts of packages, that work without ROS, and what they may not load either.
CORES = {
    'srnn_config': (),
    'srnn_access': (),
    'srnn_msgs_py': (),
    'srnn_planner.core': ('mujoco',),
    'lwr_tracking.core': (),
    'lwr_description': (),
    'lwr_guard': (),
    'lwr_sim_bridge': (),
    'lwr_fri_driver.core': (),
    'srnn_bag': (),
    'srnn_experiments': (),
    'srnn_view': (),
}
LOAD = """
import importlib, pkgutil, re, sys
package = importlib.import_module({core!r})
for module in pkgutil.walk_packages(package.__path__, package.__name__ + '.'):
    if not re.search(r'\\.ros(\\.|$)|_node$', module.name):
        importlib.import_module(module.name)
print(*sorted({{name.partition('.')[0] for name in sys.modules}}))
"""

packages = pytest.mark.parametrize('package', ORDER)
sources = [
    file for folder in ('src', 'test', 'bench', 'examples')
    for file in sorted((ROOT / folder).rglob('*.py'))
    if not {'build', 'install'} & set(file.relative_to(ROOT).parts)
]  # fmt: skip
every_source = pytest.mark.parametrize(
    'file', sources, ids=lambda file: str(file.relative_to(ROOT))
)


@cache
def setup_arguments(package):
    """Return the literal keyword arguments of the call of setup()."""
    tree = ast.parse((SRC / package / 'setup.py').read_text())
    (call,) = (
        node for node in ast.walk(tree)
        if isinstance(node, ast.Call) and ast.unparse(node.func) == 'setup'
    )  # fmt: skip
    arguments = {}
    for keyword in call.keywords:
        try:
            arguments[keyword.arg] = ast.literal_eval(keyword.value)
        except ValueError:
            arguments[keyword.arg] = ast.unparse(keyword.value)
    return arguments


@cache
def manifest(package):
    return ElementTree.parse(SRC / package / 'package.xml').getroot()


@cache
def imported_by(package):
    """Return the top-level packages that the modules of a package import, tests left out."""
    found = set()
    for file in (SRC / package / package).rglob('*.py'):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.Import):
                found.update(alias.name.partition('.')[0] for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and node.module:
                assert node.level == 0, f'{file}: relative import'
                found.add(node.module.partition('.')[0])
    return found - {package}


def test_the_order_names_every_package():
    assert {file.parent.name for file in SRC.glob('*/package.xml')} == set(ORDER)


@packages
def test_version_licence_and_description_are_the_same_everywhere(package):
    arguments, root = setup_arguments(package), manifest(package)
    assert root.get('format') == '3'
    assert root.findtext('name') == package
    assert root.findtext('version') == arguments['version'] == '0.1.0'
    assert root.findtext('license') == arguments['license'] == 'Apache-2.0'
    assert root.findtext('description') == arguments['description']
    email = root.find('maintainer').get('email')
    assert email == arguments['maintainer_email']
    assert re.fullmatch(r'[\w.+-]+@\w+(\.\w+)*\.[a-z]{2,}', email)
    assert root.findtext('export/build_type') == 'ament_python'


@packages
def test_ros_finds_the_package_and_its_executables(package):
    assert (SRC / package / 'resource' / package).is_file()
    assert (SRC / package / package / 'py.typed').is_file()
    config = ConfigParser()
    config.read(SRC / package / 'setup.cfg')
    assert config['develop']['script_dir'] == f'$base/lib/{package}'
    assert config['install']['install_scripts'] == f'$base/lib/{package}'
    assert 'ament_index/resource_index/packages' in setup_arguments(package)['data_files']


@packages
def test_executables_are_declared_and_exist(package):
    scripts = setup_arguments(package).get('entry_points', {}).get('console_scripts', [])
    declared = dict(re.split(r'\s*=\s*', script) for script in scripts)
    assert declared == EXECUTABLES.get(package, {})
    for target in declared.values():
        module, function = target.split(':')
        file = (SRC / package).joinpath(*module.split('.')).with_suffix('.py')
        names = {n.name for n in ast.parse(file.read_text()).body if hasattr(n, 'name')}
        assert function in names


@packages
def test_imports_run_downwards(package):
    allowed = set(ORDER[: ORDER.index(package)]) - STRANGERS.get(package, set())
    assert imported_by(package) & set(ORDER) <= allowed


@packages
def test_the_manifest_declares_the_ros_packages_that_are_imported(package):
    ros = {name for name in imported_by(package) if name == 'rclpy' or name.endswith('_msgs')}
    ros |= imported_by(package) & {*ORDER, 'builtin_interfaces', 'launch', 'launch_ros'}
    declared = {item.text for item in manifest(package).findall('exec_depend')}
    assert ros <= declared


@pytest.mark.parametrize('core', CORES)
def test_a_core_loads_no_middleware(core):
    done = subprocess.run(
        [sys.executable, '-c', LOAD.format(core=core)], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    loaded = set(done.stdout.split())
    forbidden = {'rclpy', 'builtin_interfaces', *CORES[core]}
    assert not loaded & forbidden
    assert not {name for name in loaded if re.search('_msgs$', name)}


@every_source
def test_every_file_is_short_and_says_its_licence(file):
    lines = file.read_text().splitlines()
    assert lines[:1] == ['# SPDX-License-Identifier: Apache-2.0'] or not lines
    assert len(lines) <= MAX_LINES


@pytest.mark.parametrize('file', sorted(SRC.rglob('*_node.py')), ids=lambda file: file.stem)
def test_a_node_only_wires(file):
    """It converts, calls the core and converts back; whatever else it does has its own file."""
    assert len(file.read_text().splitlines()) <= MAX_NODE_LINES


def test_no_two_tests_have_the_same_name():
    names = [file.name for file in sources if file.name.startswith('test_')]
    assert sorted(set(names)) == sorted(names)


@pytest.mark.parametrize(
    'name',
    [
        'requirements.lock', 'requirements-peers.txt', 'requirements-brian2.txt',
        'requirements-docs.txt', 'requirements-before-3.14.txt',
    ],
)
def test_every_package_is_pinned_by_name_and_version(name):
    for line in (ROOT / name).read_text().splitlines():
        assert line.startswith('#') or re.fullmatch(r'[A-Za-z0-9_.-]+==[0-9][0-9a-z.]*', line)
