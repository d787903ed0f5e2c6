# SPDX-License-Identifier: Apache-2.0
"""Build description of lwr_tracking."""

from setuptools import find_packages, setup

PACKAGE = 'lwr_tracking'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='Gates planned segments, follows them on the arm and stops on contact.',
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
    install_requires=['setuptools', 'numba', 'numpy'],
    extras_require={'test': ['hypothesis', 'pytest']},
    zip_safe=False,
    entry_points={
        'console_scripts': [
            'tracker = lwr_tracking.tracker_node:main',
        ],
    },
)
