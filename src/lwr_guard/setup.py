# SPDX-License-Identifier: Apache-2.0
"""Build description of lwr_guard."""

from setuptools import find_packages, setup

PACKAGE = 'lwr_guard'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='What stands between a stream of joint commands and the arm.',
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
