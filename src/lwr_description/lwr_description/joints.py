# SPDX-License-Identifier: Apache-2.0
"""Names and order of the seven joints, as FRI counts them: A1, A2, E1, A3 to A6."""

JOINT_NAMES: tuple[str, ...] = (
    'lwr_a1_joint',
    'lwr_a2_joint',
    'lwr_e1_joint',
    'lwr_a3_joint',
    'lwr_a4_joint',
    'lwr_a5_joint',
    'lwr_a6_joint',
)

DOF = len(JOINT_NAMES)
"""Number of joints."""
