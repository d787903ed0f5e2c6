# SPDX-License-Identifier: Apache-2.0
"""Build description of srnn_node."""

from setuptools import find_packages, setup

PACKAGE = 'srnn_node'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='How every node of the workspace runs: lifecycle, parameters, main loop.',
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
    extras_require={'test': ['hypothesis', 'pytest']},
    zip_safe=False,
)
