# SPDX-License-Identifier: Apache-2.0
"""What planner and adapter do with weights that are wrong, and with weights that are dead."""

from array import array
from collections.abc import Callable
import copy
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from std_msgs.msg import Float32MultiArray

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros import refusal as refusal_messages
from srnn_msgs_py.ros import weights as weight_messages
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate
from srnn_planner.core.adapter import Learner
from srnn_planner.core.errors import SrnnError
from srnn_planner.core.learned_model import LearnedModel
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planner import PlanRequest, SegmentPlanner
from srnn_planner.core.prior import PriorWeights
from srnn_planner.core.retreat import at_rest
from srnn_planner.core.synapses import Synapses
from srnn_planner.core.watched_planner import WatchedPlanner

MODEL = ModelParameters()
COUNT = MODEL.network.neurons
DEAD_AFTER = 10
FUZZED = 10_000
VERSION = 5

DEAD_PLACES = 8
"""So many places of `Victim.plan`; from the next one even a dead network finds a way."""

Spoil = Callable[[Float32MultiArray, np.random.Generator], None]


class Victim:
    """A planner that hears weights as the node does."""

    def __init__(self) -> None:
        planner = SegmentPlanner(MODEL, PlanningParameters(), np.random.default_rng(1))
        self.watched = WatchedPlanner(planner, DEAD_AFTER)
        self.refused = 0

    def hear(self, msg: Float32MultiArray) -> None:
        try:
            self.watched.take(weight_messages.from_msg(msg, neurons=COUNT))
        except (MessageError, SrnnError):
            self.refused += 1

    def plan(self, n: int = 0) -> bytes | None:
        here = 0.1 * np.array([np.cos(n), np.sin(n)])
        target = 0.6 * np.array([np.sin(2.0 * n), np.cos(3.0 * n)])
        trajectory = self.watched.plan(PlanRequest(here, at_rest(here), target, 0.1))
        return None if trajectory is None else trajectory.positions.tobytes()


def update(version: int, strength: float = 1.0) -> WeightsUpdate:
    prior = PriorWeights(MODEL.network)
    weights = prior.dense()
    weights[weights > 0.0] *= np.float32(strength)
    return WeightsUpdate(version, 1_000 * version, Synapses.of(prior, weights).learned)


@pytest.fixture(scope='module')
def good() -> Float32MultiArray:
    return weight_messages.to_msg(update(VERSION, 0.999))


@pytest.fixture(scope='module')
def pair(good) -> tuple[Victim, Victim]:
    """Return a planner that is lied to and one that is not; both plan the same all the time."""
    victim, twin = Victim(), Victim()
    for either in (victim, twin):
        either.hear(good)
        assert either.refused == 0
    return victim, twin


def label(msg: Float32MultiArray, name: str, value: object) -> None:
    dim = next(d for d in msg.layout.dim if d.label.startswith(f'{name}='))
    dim.label = f'{name}={value}'


def seal(msg: Float32MultiArray, version: int = VERSION + 1) -> None:
    """Give a message a newer version and a checksum that fits."""
    pre, post, values = np.array(msg.data, np.float32).reshape(-1, 3).T
    count = int(next(d.label for d in msg.layout.dim if d.label.startswith('neurons='))[8:])
    prior = PriorWeights(MODEL.network).checksum
    with np.errstate(invalid='ignore'):
        synapses = pre.astype(np.int64) * count + post.astype(np.int64)
    learned = LearnedWeights(count, prior, synapses, values)
    label(msg, 'version', version)
    label(msg, 'crc32', WeightsUpdate(version, 1_000 * VERSION, learned).checksum())


def one_value(value: float) -> Spoil:
    def spoil(msg: Float32MultiArray, rng: np.random.Generator) -> None:
        msg.data[int(rng.integers(len(msg.data)))] = value
        seal(msg)

    return spoil


def other_size(msg: Float32MultiArray, rng: np.random.Generator) -> None:
    label(msg, 'neurons', int(rng.integers(1, 2 * 15)) if rng.random() < 0.9 else COUNT + 1)
    seal(msg)


def other_prior(msg: Float32MultiArray, rng: np.random.Generator) -> None:
    other = replace(MODEL.network, weight_gain=rng.uniform(10.0, 70.0))
    learned = Synapses.of(PriorWeights(other), PriorWeights(MODEL.network).dense()).learned
    taken = weight_messages.to_msg(WeightsUpdate(VERSION + 1, 1_000 * VERSION, learned))
    msg.layout, msg.data = taken.layout, taken.data


def twice(msg: Float32MultiArray, rng: np.random.Generator) -> None:
    row = 3 * int(rng.integers(1, len(msg.data) // 3))
    msg.data[row : row + 2] = msg.data[row - 3 : row - 1]
    seal(msg)


def bad_checksum(msg: Float32MultiArray, rng: np.random.Generator) -> None:
    seal(msg)
    label(msg, 'crc32', int(rng.integers(2**32)))


def flipped_bit(msg: Float32MultiArray, rng: np.random.Generator) -> None:
    seal(msg)
    raw = np.frombuffer(msg.data, np.uint32)
    raw[rng.integers(len(raw))] ^= np.uint32(1 << rng.integers(32))


def half(msg: Float32MultiArray, rng: np.random.Generator) -> None:
    seal(msg)
    msg.data = msg.data[: int(rng.integers(len(msg.data)))]


def too_long(msg: Float32MultiArray, rng: np.random.Generator) -> None:
    seal(msg)
    msg.data.extend([0.0] * int(rng.integers(1, 1000)))


def other_content(msg: Float32MultiArray, rng: np.random.Generator) -> None:
    msg.data[3 * int(rng.integers(len(msg.data) // 3)) + 2] = 0.123
    seal(msg, VERSION)


def older(msg: Float32MultiArray, rng: np.random.Generator) -> None:
    rows = np.frombuffer(msg.data, np.float32).reshape(-1, 3)
    rows[:, 2] = rng.uniform(-1, 1, len(rows))
    seal(msg, int(rng.integers(VERSION)))


def no_version(msg: Float32MultiArray, rng: np.random.Generator) -> None:
    seal(msg)
    words = ('', '-1', 'nan', '1e9', '9' * 30, ' 7', '7.0', '٣', '0x7', str(10**9 + 1))
    label(msg, 'version', words[rng.integers(len(words))])


def layout(msg: Float32MultiArray, rng: np.random.Generator) -> None:
    seal(msg)
    dims = list(msg.layout.dim)
    at = int(rng.integers(len(dims)))
    match rng.integers(5):
        case 0:
            del dims[at]
        case 1:
            dims[at].label = 'version'
        case 2:
            dims[0].size += int(rng.integers(1, 1000))
        case 3:
            msg.layout.data_offset = int(rng.integers(1, 1000))
        case 4:
            dims += [copy.deepcopy(dims[0])]
    msg.layout.dim = dims


FAULTS: dict[str, Spoil] = {
    'weights of another size': other_size,
    'weights beside another prior': other_prior,
    'one synapse twice': twice,
    'weights with one NaN': one_value(np.nan),
    'weights with one infinity': one_value(-np.inf),
    'weights out of range': one_value(1.0001),
    'weights with a bad checksum': bad_checksum,
    'weights with a flipped bit': flipped_bit,
    'half a message of weights': half,
    'more weights than the layout says': too_long,
    'known version of weights, other content': other_content,
    'older version of weights': older,
    'weights with no version': no_version,
    'weights of another layout': layout,
}


@pytest.mark.parametrize('fault', FAULTS)
def test_weights_that_lie_change_no_plan(ledger, pair, good, rng, fault):
    """Row 14 of the fault matrix: dropped whole; the same plans before and after."""
    victim, twin = pair
    for n in range(ledger.repeats):
        with ledger.injection(14, fault):
            before, refused = victim.watched.planner.synapses, victim.refused
            msg = copy.deepcopy(good)
            FAULTS[fault](msg, rng)
            victim.hear(msg)
            assert victim.refused == refused + 1
            assert victim.watched.planner.synapses is before
            assert victim.plan(n) == twin.plan(n) is not None


def test_ten_thousand_fuzzed_messages_change_no_plan(ledger, pair, good, rng):
    victim, twin = pair
    faults = list(FAULTS.values())
    with ledger.injection(14, f'{FUZZED} fuzzed messages of weights'):
        before, refused = victim.watched.planner.synapses, victim.refused
        for n in range(FUZZED):
            msg = Float32MultiArray(
                layout=copy.deepcopy(good.layout), data=array('f', good.data.tobytes())
            )
            faults[n % len(faults)](msg, rng)
            victim.hear(msg)
            if n % (FUZZED // 5) == 0:
                assert victim.plan(n) == twin.plan(n) is not None
        assert victim.refused == refused + FUZZED
        assert victim.watched.planner.synapses is before
        assert victim.plan() == twin.plan() is not None


@pytest.mark.parametrize('moment', ['without an adapter', 'with an adapter'])
def test_a_dead_model_is_noticed_and_left_and_learning_goes_on_from_the_good_one(
    ledger, good, moment
):
    for n in range(ledger.repeats):
        place = n % DEAD_PLACES
        with ledger.injection(14, f'dead model, {moment}'):
            victim, learner = Victim(), Learner(MODEL, np.random.default_rng([n, 1]))
            adapter = LearnedModel(learner, weight_messages.from_msg(good))
            victim.hear(good)
            assert victim.plan(place) is not None
            everywhere = np.full((COUNT, COUNT), -1.0, np.float32)
            dead = Synapses.of(learner.neurons.prior, everywhere).learned
            adapter.load(WeightsUpdate(1, 0, dead), 0)
            victim.hear(weight_messages.to_msg(adapter.weights))
            assert [victim.plan(place) for _ in range(DEAD_AFTER)] == [None] * DEAD_AFTER
            assert 'version 6: trying older ones' in victim.watched.watch.trouble
            assert victim.plan(place) is not None
            told = victim.watched.refusal
            assert (told.refused_version, told.good_version) == (6, 5)
            if moment == 'with an adapter':
                told = refusal_messages.from_msg(refusal_messages.to_msg(told))
                assert adapter.leave(told, 1).version == 6
                assert adapter.weights.version == 7
                known = weight_messages.from_msg(good).learned
                assert learner.synapses.learned.same_as(known)
                victim.hear(weight_messages.to_msg(adapter.weights))
                assert victim.watched.watch.trouble == ''
            victim.hear(weight_messages.to_msg(WeightsUpdate(6, 0, dead)))
            assert victim.refused == 1
            assert all(victim.plan(k) is not None for k in range(3))


def test_a_watched_planner_plans_what_an_unwatched_one_plans(good):
    victim = Victim()
    bare = SegmentPlanner(MODEL, PlanningParameters(), np.random.default_rng(1))
    plan = partial(PlanRequest, velocity=0.1)
    for n in range(6):
        if n == 3:
            victim.hear(good)
            bare.use_weights(weight_messages.from_msg(good).learned)
        here = 0.1 * np.array([np.cos(n), np.sin(n)])
        target = 0.6 * np.array([np.sin(2.0 * n), np.cos(3.0 * n)])
        expected = bare.plan(plan(here, at_rest(here), target)).trajectory
        assert victim.plan(n) == expected.positions.tobytes()
