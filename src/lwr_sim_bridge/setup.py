# SPDX-License-Identifier: Apache-2.0
"""Build description of lwr_sim_bridge."""

from setuptools import find_packages, setup

PACKAGE = 'lwr_sim_bridge'

setup(
    name=PACKAGE,
    version='0.1.0',
    description='KUKA LWR 4+ in MuJoCo behind the topics of the real arm.',
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
    install_requires=['setuptools', 'mujoco>=3.12,<4', 'numba', 'numpy'],
    extras_require={'test': ['hypothesis', 'pytest']},
    zip_safe=False,
    entry_points={
        'console_scripts': [
            'sim_bridge = lwr_sim_bridge.bridge_node:main',
            'mock_arm = lwr_sim_bridge.mock_arm_node:main',
            'fri_emulator = lwr_sim_bridge.fri.emulator_node:main',
        ],
    },
)
