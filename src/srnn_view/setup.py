# SPDX-License-Identifier: Apache-2.0
"""Build description of srnn_view."""

from setuptools import find_packages, setup

PACKAGE = 'srnn_view'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='A running graph as a local web page: the arm, what it plans and what it learns.',
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
    install_requires=[
        'setuptools', 'matplotlib', 'mujoco>=3.12,<4', 'numpy', 'trimesh', 'viser>=1.1,<2',
    ],
    extras_require={'test': ['pytest']},
    zip_safe=False,
    entry_points={'console_scripts': ['view = srnn_view.view_node:main']},
)
