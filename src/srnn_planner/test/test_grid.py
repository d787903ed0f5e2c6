# SPDX-License-Identifier: Apache-2.0
"""The grid in whole numbers, against the positions of its neurons."""

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np

from srnn_planner.core.grid import Grid
from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.state_neurons import StateNeurons

grids = st.sampled_from([(3, 1), (12, 1), (3, 2), (7, 2), (3, 3), (5, 3)])


@given(grids)
def test_neurons_are_numbered_as_their_positions_are(shape):
    side, dimensions = shape
    grid = Grid(side, dimensions)
    parameters = NetworkParameters(dimensions=dimensions, neurons_per_dimension=side)
    positions = StateNeurons(parameters).positions
    np.testing.assert_allclose(2.0 * grid.coordinates / (side - 1) - 1.0, positions, atol=1e-12)
    assert np.array_equal(grid.coordinates @ grid.strides, np.arange(grid.count))


@given(grids)
def test_neurons_are_as_far_apart_as_their_coordinates(shape):
    grid = Grid(*shape)
    everybody = np.arange(grid.count)
    apart = grid.apart(everybody[:, None], everybody)
    steps = np.abs(grid.coordinates[:, None] - grid.coordinates)
    assert np.array_equal(grid.coordinates[apart], steps)


@given(grids, st.integers(1, 4))
def test_pairs_are_all_neurons_within_reach_and_on_the_grid(shape, reach):
    grid = Grid(*shape)
    offsets = grid.offsets(reach)
    which, offset = grid.pairs(np.arange(grid.count), offsets)
    other = which + (offsets @ grid.strides)[offset]
    steps = np.abs(grid.coordinates[:, None] - grid.coordinates).max(axis=2)
    expected = np.argwhere(steps <= reach)
    # Sorted by both, without a pair twice.
    assert np.array_equal(np.column_stack([which, other]), expected)


@settings(max_examples=30)
@given(grids, st.integers(1, 4))
def test_neurons_of_a_kind_have_the_same_neighbours_by_number(shape, reach):
    grid = Grid(*shape)
    reach = min(reach, grid.side - 1)
    examples, kind = grid.alike(reach)
    offsets = grid.offsets(reach)
    shift = offsets @ grid.strides
    assert np.array_equal(kind[examples], np.arange(len(examples)))
    for k in range(grid.count):
        own, like = (grid.pairs(np.array([n]), offsets)[1] for n in (k, examples[kind[k]]))
        assert np.array_equal(shift[own], shift[like])
