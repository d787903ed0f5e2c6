# SPDX-License-Identifier: Apache-2.0
"""What a user may choose of an experiment, by name; pure, as a command line has to be."""

WORLDS = ('mujoco', 'point')
AGENTS = ('network', 'oracle', 'grid')
"""Who plans: the network; the network told of every obstacle; A* that marks contacts."""
