# SPDX-License-Identifier: Apache-2.0
"""Build description of lwr_description."""

from glob import glob

from setuptools import find_packages, setup

PACKAGE = 'lwr_description'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='KUKA LWR 4+: models, limits, kinematics and dynamics.',
    license='Apache-2.0',
    maintainer='srnn workspace maintainers',
    maintainer_email='maintainers@example.org',
    python_requires='>=3.11',
    packages=find_packages(exclude=['test']),
    package_data={PACKAGE: ['py.typed', 'models/*']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{PACKAGE}']),
        (f'share/{PACKAGE}', ['package.xml']),
        (f'share/{PACKAGE}/models', sorted(glob(f'{PACKAGE}/models/*'))),
    ],
    install_requires=['setuptools', 'llvmlite', 'mujoco>=3.12,<4', 'numba', 'numpy'],
    extras_require={'test': ['hypothesis', 'pytest']},
    zip_safe=False,
)
