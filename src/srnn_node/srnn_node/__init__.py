# SPDX-License-Identifier: Apache-2.0
"""How every node of the workspace runs: lifecycle, parameters, main loop, real time."""
