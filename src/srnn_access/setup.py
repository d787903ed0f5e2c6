# SPDX-License-Identifier: Apache-2.0
"""Build description of srnn_access."""

from setuptools import find_packages, setup

PACKAGE = 'srnn_access'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='Who may command the arm: keys, marks, seals, and the rules of whoever receives.',
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
    install_requires=['setuptools'],
    extras_require={'test': ['hypothesis', 'pytest']},
    zip_safe=False,
)
