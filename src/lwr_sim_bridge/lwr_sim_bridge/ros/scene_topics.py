# SPDX-License-Identifier: Apache-2.0
"""The world around a simulated arm on topics and services: contacts, segments, obstacles."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from std_srvs.srv import SetBool

from lwr_sim_bridge.simulated_arm import SimulatedArm
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import result, wrench
from srnn_msgs_py.segment import FRAME
from srnn_msgs_py.wrench import Wrench
from srnn_node.lifecycle import WorkspaceNode


class SceneTopics:
    """Counts segments, lets obstacles appear and vanish, and reports the truth for scoring."""

    def __init__(
        self, node: WorkspaceNode, obstacles: int, arm: Callable[[], SimulatedArm]
    ) -> None:
        """Connect to the topics of `node`, which is being configured.

        Args:
            node: whose topics and services they are.
            obstacles: how many the scene has.
            arm: returns the arm as it is now.

        """
        self.segments = 0
        self._arm = arm
        self._truth = node.advertise('contact_truth')
        node.listen('segment_result', result.from_msg, self._on_result)
        for index in range(obstacles):
            node.create_service(
                SetBool, f'~/set_obstacle_{index}', partial(self._on_set_obstacle, index)
            )

    def report(self, stamp_ns: int) -> None:
        """Report the largest low-passed force since the last report, in its direction."""
        truth = self._arm().truth
        size = float(np.linalg.norm(truth.low_pass))
        direction = truth.low_pass / size if size > 1e-9 else np.array([1.0, 0.0, 0.0])
        peak = Wrench(stamp_ns, FRAME, truth.peak * direction, np.zeros(3))
        self._truth.publish(wrench.to_msg(peak))
        self._arm().clear_peak()

    def _on_result(self, value: SegmentResult) -> None:
        if value.code in (ResultCode.DONE, ResultCode.BLOCKED):
            self.segments += 1
            self._arm().set_segment(self.segments)

    def _on_set_obstacle(self, index: int, request: Any, response: Any) -> Any:
        self._arm().set_obstacle(index, request.data)
        present = ', '.join(map(str, self._arm().obstacles_present)) or 'none'
        response.success, response.message = True, f'obstacles present: {present}'
        return response
