# SPDX-License-Identifier: Apache-2.0
"""Experiments on the cores alone: no middleware, simulated time, the same for a seed."""
