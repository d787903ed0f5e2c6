# SPDX-License-Identifier: Apache-2.0
"""The time that planners of OMPL have."""

BUDGET = 0.05
"""What RRT* has for a query, and what the search of RRT-Connect may take at most [s]."""
