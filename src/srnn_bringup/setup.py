# SPDX-License-Identifier: Apache-2.0
"""Build description of srnn_bringup."""

import os
from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = 'srnn_bringup'

HERE = Path(__file__).resolve().parent
CONFIG = HERE.parents[1] / 'config'


def files(folder: Path, pattern: str) -> list[str]:
    """Return the matching files relative to where setuptools runs."""
    return sorted(os.path.relpath(path) for path in folder.glob(pattern))


setup(
    name=PACKAGE,
    version='0.1.0',
    description='Starts the graph: launch files, configuration and the srnn command.',
    license='Apache-2.0',
    maintainer='srnn workspace maintainers',
    maintainer_email='maintainers@example.org',
    python_requires='>=3.11',
    packages=find_packages(exclude=['test']),
    package_data={PACKAGE: ['py.typed', 'page/*.css', 'page/*.js']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{PACKAGE}']),
        (f'share/{PACKAGE}', ['package.xml']),
        (
            f'share/{PACKAGE}/config',
            [f for kind in ('yaml', 'xml', 'rviz', 'json') for f in files(CONFIG, f'*.{kind}')],
        ),
        (f'share/{PACKAGE}/config/arms', files(CONFIG / 'arms', '*.yaml')),
        (f'share/{PACKAGE}/config/scenes', files(CONFIG / 'scenes', '*.yaml')),
        (f'share/{PACKAGE}/launch', files(HERE / 'launch', '*.launch.py')),
    ],
    install_requires=[
        'setuptools', 'PyYAML', 'cryptography', 'matplotlib', 'numpy', 'shtab', 'tqdm',
    ],
    extras_require={'test': ['hypothesis', 'pytest']},
    zip_safe=False,
    entry_points={
        'console_scripts': [
            'srnn = srnn_bringup.cli:main',
        ],
    },
)
