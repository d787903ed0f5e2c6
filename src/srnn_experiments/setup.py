# SPDX-License-Identifier: Apache-2.0
"""Build description of srnn_experiments."""

from setuptools import find_packages, setup

PACKAGE = 'srnn_experiments'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='The whole system in one process on simulated time, for experiments and tests.',
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
    install_requires=['setuptools', 'numpy', 'threadpoolctl'],
    extras_require={'dask': ['distributed'], 'test': ['hypothesis', 'pytest']},
    zip_safe=False,
)
