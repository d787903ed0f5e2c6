# SPDX-License-Identifier: Apache-2.0
"""Where something is or what acts there: three numbers, which plain Python is faster with."""

Point = tuple[float, float, float]
"""x, y and z in `srnn_workspace` [m]; of a force [N]."""
