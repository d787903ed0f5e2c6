# SPDX-License-Identifier: Apache-2.0
"""The learned map is where the neurons are, as a grid and as columns."""

import numpy as np
import pytest

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros import belief, belief_markers

HALF = 0.3
INHIBITION = np.zeros((15, 15))
INHIBITION[9, 4], INHIBITION[3, 12] = 0.08, 0.04
CELL = 2.0 * HALF / 14


def place(x: int, y: int) -> list[float]:
    return [-HALF + CELL * x, -HALF + CELL * y]


def test_the_columns_stand_on_their_neurons_the_taller_the_more_was_learned(wire):
    msg = wire(belief_markers.to_msg(INHIBITION, HALF, 12))
    gone, less, most = msg.markers
    assert gone.action == gone.DELETEALL
    for marker, (x, y), share in ((most, (9, 4), 1.0), (less, (3, 12), 0.5)):
        assert marker.header.frame_id == 'srnn_workspace'
        at = marker.pose.position
        np.testing.assert_allclose([at.x, at.y], place(x, y), atol=1e-12)
        np.testing.assert_allclose(marker.scale.z, share * belief_markers.TALLEST)
        np.testing.assert_allclose(at.z, marker.scale.z / 2.0)
    assert less.id != most.id


def test_nothing_learned_is_nothing_to_show(wire):
    assert len(wire(belief_markers.to_msg(np.zeros((15, 15)), HALF, 12)).markers) == 1


def test_the_cells_of_the_grid_are_around_their_neurons(wire):
    msg = wire(belief.to_msg(INHIBITION, HALF, 12))
    data = np.array(msg.data).reshape(msg.info.height, msg.info.width)
    assert (data[4, 9], data[12, 3], data.sum()) == (100, 50, 150)
    corner = msg.info.origin.position
    np.testing.assert_allclose(
        [corner.x + msg.info.resolution * 9.5, corner.y + msg.info.resolution * 4.5],
        place(9, 4), atol=1e-7,
    )  # fmt: skip


def test_a_grid_is_read_as_it_was_written(wire):
    inhibition, (x, y), cell = belief.from_msg(wire(belief.to_msg(INHIBITION, HALF, 12)))
    assert (inhibition[4, 9], inhibition[12, 3], inhibition.sum()) == (1.0, 0.5, 1.5)
    np.testing.assert_allclose([x + 9.5 * cell, y + 4.5 * cell], place(9, 4), atol=1e-7)


def test_a_grid_without_all_its_cells_is_refused():
    msg = belief.to_msg(INHIBITION, HALF, 12)
    msg.info.height = 14
    with pytest.raises(MessageError, match='data: 225 cells: must be 14 x 15'):
        belief.from_msg(msg)
