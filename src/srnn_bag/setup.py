# SPDX-License-Identifier: Apache-2.0
"""Build description of srnn_bag."""

from setuptools import find_packages, setup

PACKAGE = 'srnn_bag'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='Recordings of the graph: MCAP files in the layout of rosbag2, written and read.',
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
    install_requires=['setuptools', 'PyYAML', 'lz4', 'mcap', 'zstandard'],
    extras_require={'test': ['hypothesis', 'mcap-ros2-support', 'numpy', 'pytest', 'rosbags']},
    zip_safe=False,
)
