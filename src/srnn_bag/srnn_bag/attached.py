# SPDX-License-Identifier: Apache-2.0
"""Names of the files that a bag of a run has attached."""

RUN = 'run.json'
"""What code ran, by which command, on what arm, with which seed."""

SCENE = 'scene.yaml'
START_WEIGHTS = 'start_weights.npz'

PARAMETERS = 'parameters/{}.yaml'
"""ROS parameter file of a node."""
