# SPDX-License-Identifier: Apache-2.0
"""Gate, tracking law, contact stop and fail-safe between planner and arm."""
