# SPDX-License-Identifier: Apache-2.0
"""What people are shown of planning: the way points, and what a segment was chosen from."""

from srnn_msgs_py.ros import markers, samples, spikes
from srnn_node.lifecycle import WorkspaceNode
from srnn_planner.core.planning_session import PlanningSession


class PlanningDisplay:
    """Publishes for RViz and others; nothing is decided by it."""

    def __init__(
        self, node: WorkspaceNode, session: PlanningSession, reach_radius: float
    ) -> None:
        """Connect to the topics of `node`, which is being configured.

        Args:
            node: whose topics they are.
            session: decides.
            reach_radius: of the way points [m].

        """
        self._session = session
        self._reach_radius = reach_radius
        self._markers = node.advertise('markers')
        self._samples = node.advertise('samples')
        self._spikes = node.advertise('spikes')

    def waypoints(self, now_ns: int) -> None:
        """Show the way points, and which of them is next."""
        tour = self._session.waypoints(now_ns)
        active = self._session.sequencer.task.active
        self._markers.publish(markers.to_msg(tour, active, self._reach_radius))

    def imagination(self, stamp_ns: int) -> None:
        """Show what segment `stamp_ns` was chosen from, if somebody looks on."""
        listeners = self._samples.get_subscription_count() + self._spikes.get_subscription_count()
        value = self._session.imagination(stamp_ns) if listeners else None
        if value is not None:
            self._samples.publish(samples.to_msg(value))
            self._spikes.publish(spikes.to_msg(value))
