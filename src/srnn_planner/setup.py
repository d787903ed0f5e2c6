# SPDX-License-Identifier: Apache-2.0
"""Build description of srnn_planner."""

from setuptools import find_packages, setup

PACKAGE = 'srnn_planner'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='Motion planning with a spiking network that learns obstacles from contacts.',
    license='Apache-2.0',
    maintainer='srnn workspace maintainers',
    maintainer_email='maintainers@example.org',
    python_requires='>=3.11',
    packages=find_packages(exclude=['test']),
    package_data={PACKAGE: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{PACKAGE}']),
        (f'share/{PACKAGE}', ['package.xml']),
    ],
    install_requires=['setuptools', 'llvmlite', 'numba', 'numpy'],
    extras_require={'test': ['hypothesis', 'pytest']},
    zip_safe=False,
    entry_points={
        'console_scripts': [
            'planner = srnn_planner.nodes.planner_node:main',
            'adapter = srnn_planner.nodes.adapter_node:main',
        ],
    },
)
