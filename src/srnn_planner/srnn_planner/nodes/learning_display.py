# SPDX-License-Identifier: Apache-2.0
"""What people are shown of learning: what is believed, and what it was learned from."""

import numpy as np

from srnn_msgs_py.ros import belief, belief_markers
from srnn_msgs_py.ros import path as path_msg
from srnn_node.lifecycle import WorkspaceNode
from srnn_planner.core.learning_session import Learned
from srnn_planner.core.parameters import ModelParameters
from srnn_planner.core.synapses import Synapses
from srnn_planner.core.synaptic_change import input_change


class LearningDisplay:
    """Publishes for RViz and others; nothing is decided by it."""

    def __init__(self, node: WorkspaceNode, model: ModelParameters) -> None:
        """Connect to the topics of `node`, which is being configured."""
        self._model = model
        self._belief = node.advertise('belief')
        self._columns = node.advertise('belief_markers')
        self._segment_path = node.advertise('segment_path')
        self._executed_path = node.advertise('executed_path')

    def weights(self, synapses: Synapses, now_ns: int) -> None:
        """Show where the plane is believed to be blocked; only a plane can be shown."""
        network = self._model.network
        if network.dimensions != 2:
            return
        change = input_change(synapses, Synapses(synapses.prior))
        side = network.neurons_per_dimension
        inhibition = np.maximum(-change, 0.0).reshape(side, side)
        extent = self._model.workspace.half_extent
        self._belief.publish(belief.to_msg(inhibition, extent, now_ns))
        self._columns.publish(belief_markers.to_msg(inhibition, extent, now_ns))

    def pair(self, learned: Learned) -> None:
        """Show a plan and how it was executed."""
        self._segment_path.publish(path_msg.to_msg(learned.plan))
        self._executed_path.publish(path_msg.to_msg(learned.path))
