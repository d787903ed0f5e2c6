# SPDX-License-Identifier: Apache-2.0
"""Laws of the grid, its basis and the prior weights."""

import numpy as np
import pytest

from srnn_config import ParameterError
from srnn_planner.core.errors import SrnnError, WeightsError
from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses

DEFAULT = NetworkParameters()


@pytest.mark.parametrize(('dimensions', 'per_dimension'), [(1, 31), (2, 15), (2, 21), (3, 5)])
def test_grid_fills_the_workspace_in_any_dimension(dimensions, per_dimension):
    parameters = NetworkParameters(dimensions=dimensions, neurons_per_dimension=per_dimension)
    positions = StateNeurons(parameters).positions
    assert positions.shape == (per_dimension**dimensions, dimensions)
    assert positions.min() == -1.0
    assert positions.max() == 1.0
    assert len(np.unique(positions, axis=0)) == parameters.neurons


def test_prior_weights_do_not_grow_with_distance():
    neurons = StateNeurons(DEFAULT)
    distance = np.linalg.norm(neurons.positions - neurons.positions[112], axis=1)
    weights = neurons.prior_weights[112][np.argsort(distance, kind='stable')]
    assert (np.diff(weights) <= 1e-6).all()


def test_near_neurons_excite_and_distant_ones_inhibit():
    weights = StateNeurons(DEFAULT).prior_weights
    centre, neighbour, far = 112, 113, 0
    assert weights[centre, neighbour] == 1.0
    assert weights[centre, far] == pytest.approx(-DEFAULT.weight_offset, abs=1e-6)


def test_prior_weights_are_symmetric_bounded_and_frozen():
    weights = StateNeurons(DEFAULT).prior_weights
    assert np.array_equal(weights, weights.T)
    assert np.abs(weights).max() <= 1.0
    with pytest.raises(ValueError, match='read-only'):
        weights[0, 0] = 0.0


def test_responsibilities_are_a_distribution_even_far_outside(rng):
    points = rng.uniform(-3.0, 3.0, (50, 2))
    omega = StateNeurons(DEFAULT).responsibilities(points)
    assert (omega >= 0.0).all()
    assert omega.sum(axis=1) == pytest.approx(np.ones(50))


def test_responsibilities_are_the_normalised_basis(rng):
    points = rng.uniform(-1.0, 1.0, (20, 2))
    neurons = StateNeurons(DEFAULT)
    basis = neurons.basis(points)
    expected = basis / basis.sum(axis=1, keepdims=True)
    assert neurons.responsibilities(points) == pytest.approx(expected)


@pytest.mark.parametrize('spoil', ['shape', 'nan', 'range'])
def test_weights_that_do_not_fit_are_refused(spoil):
    neurons = StateNeurons(DEFAULT)
    weights = neurons.prior_weights.copy()
    if spoil == 'shape':
        weights = weights[:-1]
    else:
        weights[3, 4] = np.nan if spoil == 'nan' else 1.5
    with pytest.raises(WeightsError) as error:
        Synapses.of(neurons.prior, weights)
    assert isinstance(error.value, SrnnError)
    assert isinstance(error.value, ValueError)


def test_impossible_network_is_refused_with_name_value_and_bounds():
    with pytest.raises(ParameterError, match=r'tau = 0.*>= 1.*steps'):
        NetworkParameters(tau=0)
