# SPDX-License-Identifier: Apache-2.0
"""Build description of lwr_fri_driver."""

from setuptools import find_packages, setup

PACKAGE = 'lwr_fri_driver'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='Drives a real KUKA LWR 4+ over its Fast Research Interface.',
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
    entry_points={
        'console_scripts': [
            'fri_driver = lwr_fri_driver.driver_node:main',
        ],
    },
)
