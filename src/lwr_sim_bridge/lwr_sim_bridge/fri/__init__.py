# SPDX-License-Identifier: Apache-2.0
"""The controller's side of FRI 1.0, with the simulated arm behind it.

Written from the published facts alone, and independent of `lwr_fri_driver`: neither can
hide a mistake of the other.
"""
