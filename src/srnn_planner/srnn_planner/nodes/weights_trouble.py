# SPDX-License-Identifier: Apache-2.0
"""Tells of weights that are dead: the adapter at once, everybody else once."""

from srnn_msgs_py.ros import refusal
from srnn_node.lifecycle import WorkspaceNode
from srnn_planner.core.watched_planner import WatchedPlanner


class WeightsTrouble:
    """What went wrong with weights, told to whom it concerns.

    Attributes:
        refused: publisher of what the adapter must know.

    """

    def __init__(self, node: WorkspaceNode, watched: WatchedPlanner) -> None:
        """Connect to the topics of `node`, which is being configured and plans with `watched`."""
        self.refused = node.advertise('weights_refused')
        self._node = node
        self._watched = watched
        self._told = ''

    def tell(self) -> None:
        """Tell what is new."""
        if self._watched.refusal is not None:
            self.refused.publish(refusal.to_msg(self._watched.refusal))
            self._watched.refusal = None
        trouble = self._watched.watch.trouble
        if trouble and trouble != self._told:
            self._node.get_logger().error(trouble)
            self._node.report_health()
        self._told = trouble
