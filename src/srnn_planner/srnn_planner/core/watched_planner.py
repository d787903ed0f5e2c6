# SPDX-License-Identifier: Apache-2.0
"""A planner that does not stay with weights under which it finds no plan."""

from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core.model_watch import ModelWatch
from srnn_planner.core.planner import Plan, PlanRequest, SegmentPlanner
from srnn_planner.core.trajectory import Trajectory


class WatchedPlanner:
    """Plans with the newest weights that work.

    Attributes:
        planner: samples the segments.
        watch: knows which weights are good.
        refusal: what the adapter must be told; whoever tells it sets this to None.
        last: the last plan, None before the first.

    """

    def __init__(self, planner: SegmentPlanner, dead_after: int) -> None:
        """Watch over a planner; so many invalid plans in a row are too many."""
        self.planner = planner
        self.watch = ModelWatch(planner.synapses.learned, dead_after)
        self.refusal: WeightsRefusal | None = None
        self.last: Plan | None = None

    def take(self, weights: WeightsUpdate) -> None:
        """Use new weights for the next segment, all or nothing.

        Raises:
            WeightsError: of another network, not finite, not in [-1, 1], of an older
                version, or dead; the old ones stay.

        """
        self.watch.check(weights)
        self.planner.use_weights(weights.learned)
        self.watch.take(weights)

    def plan(self, request: PlanRequest) -> Trajectory | None:
        """Return the next segment, None if no valid movement was found."""
        self.last = self.planner.plan(request)
        trajectory = self.last.trajectory
        if trajectory is not None:
            self.refusal = self.watch.planned() or self.refusal
        elif self.watch.failed():
            self.planner.use_weights(self.watch.in_use.learned)
        return trajectory
