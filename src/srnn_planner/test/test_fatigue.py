# SPDX-License-Identifier: Apache-2.0
"""Who gets nowhere tires of it and goes another way; who gets on does not notice."""

import numpy as np
import pytest

from srnn_planner.core.fatigue import Fatigue
from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses
from srnn_planner.core.ways import Ways

NEURONS = StateNeurons(NetworkParameters())
PRIOR = NEURONS.prior_weights
FREE = np.zeros(len(NEURONS.positions))
HERE, TARGET, ELSEWHERE = np.zeros(2), np.array([0.8, 0.0]), np.array([-0.8, 0.0])


def free_tolls(ways):
    return ways.tolls(Synapses(NEURONS.prior), FREE, 6.0)


def omega(position):
    return NEURONS.responsibilities(position[None])[0]


def nearest(x, y):
    return int(np.argmin(np.linalg.norm(NEURONS.positions - [x, y], axis=1)))


def tired(visits):
    fatigue = Fatigue(len(NEURONS.positions))
    for _ in range(visits):
        fatigue.visit(omega(HERE), TARGET)
    return fatigue


def test_every_visit_counts_once_and_most_where_the_arm_was():
    fatigue = tired(5)
    assert fatigue.visits.sum() == pytest.approx(5.0)
    assert np.argmax(fatigue.visits) == nearest(0.0, 0.0)


def test_another_target_is_approached_afresh():
    fatigue = tired(5)
    fatigue.visit(omega(HERE), ELSEWHERE)
    assert fatigue.visits.sum() == pytest.approx(1.0)
    fatigue.visit(omega(HERE), TARGET)
    assert fatigue.visits.sum() == pytest.approx(1.0)


def test_fatigue_makes_ways_longer_from_where_the_arm_was_and_none_shorter():
    ways = Ways(NEURONS, FREE)
    rested = ways.remaining(free_tolls(ways), TARGET, FREE)
    after = ways.remaining(free_tolls(ways), TARGET, 8.0 * tired(6).visits)
    assert (after >= rested - 1e-12).all()
    assert after[nearest(0.0, 0.0)] > rested[nearest(0.0, 0.0)] + 0.2
    # Behind it, the way leads round; between it and the target nothing changes.
    ahead = nearest(0.5, 0.0)
    assert after[ahead] == pytest.approx(rested[ahead], abs=1e-4)


def test_the_longer_way_round_wins_in_the_end():
    """A wall with a near and a far end: fatigue before the near one turns the arm round."""
    weights = PRIOR.copy()
    x, y = NEURONS.positions.T
    weights[:, (np.abs(x - 0.3) < 0.2) & (y > -0.5) & (y < 0.3)] = -1.0
    ways, fatigue = Ways(NEURONS, FREE), Fatigue(len(NEURONS.positions))
    synapses = Synapses.of(NEURONS.prior, weights)
    tolls = ways.tolls(synapses, ways.blockage.of(synapses), 6.0)
    near, far = nearest(0.0, 0.43), nearest(0.0, -0.57)

    def remaining():
        return ways.remaining(tolls, TARGET, 8.0 * fatigue.visits)

    assert remaining()[near] < remaining()[far]
    for _ in range(20):
        fatigue.visit(omega(NEURONS.positions[near]), TARGET)
    assert remaining()[near] > remaining()[far]
