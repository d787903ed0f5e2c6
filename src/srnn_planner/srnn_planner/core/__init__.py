# SPDX-License-Identifier: Apache-2.0
"""The method of Tanneberg, Peters and Rueckert (Neural Networks, 2019), free of middleware.

Everything in here counts in neuron coordinates, where the workspace is [-1, 1]^d;
`Workspace` is the one door to metres. State and random numbers are arguments.
"""
