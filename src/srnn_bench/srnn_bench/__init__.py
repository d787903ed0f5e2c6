# SPDX-License-Identifier: Apache-2.0
"""The planner beside other simulators and other planners, timed in turn on one machine."""
