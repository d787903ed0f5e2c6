# SPDX-License-Identifier: Apache-2.0
"""Planner and adapter: a stochastic spiking recurrent network that plans and learns."""
