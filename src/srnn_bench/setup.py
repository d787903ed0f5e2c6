# SPDX-License-Identifier: Apache-2.0
"""Build description of srnn_bench."""

from setuptools import find_packages, setup

PACKAGE = 'srnn_bench'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='The planner beside other simulators and other planners, timed in turn.',
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
    install_requires=['setuptools', 'numpy'],
    extras_require={
        'peers': ['brian2', 'nest-simulator', 'ompl'],
        'test': ['pytest', 'threadpoolctl'],
    },
    zip_safe=False,
)
