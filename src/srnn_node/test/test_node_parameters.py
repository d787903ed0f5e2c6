# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, field
import math

import pytest
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.parameter import Parameter

from srnn_config import Parameters, parameter
from srnn_node.lifecycle import WorkspaceNode


@dataclass(frozen=True)
class Kernel(Parameters):
    """A nested set."""

    sigma: float = parameter(0.11, unit='m', above=0.0, maximum=1.0, doc='Width.')
    rule: str = parameter('mode', choices=('mode', 'mean'), doc='How samples are joined.')


@dataclass(frozen=True)
class Settings(Parameters):
    """Every kind of field."""

    samples: int = parameter(40, minimum=1, maximum=1000, doc='Samples per plan.')
    gain: float = parameter(2.0, minimum=0.0, doc='Gain.')
    home: tuple[float, ...] = parameter((0.1, 0.2), unit='rad', length=2, doc='Home.')
    marks: tuple[int, ...] = parameter((), doc='Marks.')
    verbose: bool = parameter(False, doc='Say more.')
    kernel: Kernel = field(default_factory=Kernel)


class Settled(WorkspaceNode):
    """Keeps what it was given."""

    PARAMETERS = Settings

    def configure(self, parameters):
        self.parameters = parameters


@pytest.fixture
def configured(bench):
    def make(**given):
        overrides = [
            Parameter(name.replace('__', '.'), value=value) for name, value in given.items()
        ]
        node = bench.add(
            Settled('settled', context=bench.context, parameter_overrides=overrides)
        )
        return node, node.trigger_configure()

    return make


def test_defaults_become_parameters_with_meaning_and_bounds(configured):
    node, result = configured()
    assert result == TransitionCallbackReturn.SUCCESS
    assert node.parameters == Settings()
    assert node.get_parameter('kernel.sigma').value == 0.11
    assert node.get_parameter('home').value == [0.1, 0.2]
    sigma = node.describe_parameter('kernel.sigma')
    assert (sigma.description, sigma.additional_constraints) == ('Width. [m]', '> 0 and <= 1')
    assert sigma.read_only
    assert sigma.floating_point_range[0].from_value == math.nextafter(0.0, 1.0)
    assert sigma.floating_point_range[0].to_value == 1.0
    assert node.describe_parameter('gain').floating_point_range[0].to_value == math.inf
    samples = node.describe_parameter('samples').integer_range[0]
    assert (samples.from_value, samples.to_value) == (1, 1000)
    assert node.describe_parameter('kernel.rule').additional_constraints == 'one of mode, mean'


def test_what_the_user_gives_is_what_the_node_gets_and_declares(configured):
    node, result = configured(
        samples=7, gain=3, home=[1.0, 2.0], marks=[4], verbose=True, kernel__rule='mean'
    )
    assert result == TransitionCallbackReturn.SUCCESS, node.failure
    assert node.parameters == Settings(7, 3.0, (1.0, 2.0), (4,), True, Kernel(rule='mean'))
    assert node.get_parameter('gain').value == 3.0
    assert node.get_parameter('kernel.rule').value == 'mean'


def test_the_same_parameters_come_back_at_the_second_configuration(configured):
    node, _ = configured(samples=7)
    node.trigger_cleanup()
    assert node.trigger_configure() == TransitionCallbackReturn.SUCCESS
    assert node.parameters.samples == 7


@pytest.mark.parametrize(
    ('given', 'complaint'),
    [
        ({'sample': 7}, "unknown key 'sample' (did you mean 'samples'?); valid keys: samples, "),
        ({'kernel__width': 0.2}, "settled.kernel: unknown key 'width'; valid keys: sigma, rule"),
        ({'samples': 0}, 'samples = 0: must be >= 1 and <= 1000'),
        ({'samples': 1.5}, 'samples = 1.5: must be a whole number: >= 1 and <= 1000'),
        ({'kernel__sigma': 0.0}, 'sigma = 0.0: must be > 0 and <= 1 [m]'),
        ({'kernel__sigma': math.nan}, 'sigma = nan: must be > 0 and <= 1 [m]'),
        ({'kernel__rule': 'best'}, "rule = 'best': must be one of mode, mean"),
        ({'home': [1.0]}, 'must be 2 values, each finite [rad]'),
        ({'verbose': 1}, 'verbose = 1: must be true or false'),
        ({'kernel': 1}, 'settled.kernel: must be a mapping of keys to values'),
        ({'samples__more': 1}, "samples = {'more': 1}: must be a number"),
        ({'samples': 1, 'samples__more': 1}, 'samples is a value and has no parts'),
    ],
)
def test_what_is_unknown_or_impossible_is_refused_naming_what_is_valid(
    configured, given, complaint
):
    node, result = configured(**given)
    assert result == TransitionCallbackReturn.FAILURE
    assert node.state == 'unconfigured'
    assert complaint in node.failure


def test_parameters_of_ros_itself_are_let_through(configured):
    node, result = configured(use_sim_time=False, qos_overrides___=1, autostart=False)
    assert result == TransitionCallbackReturn.SUCCESS, node.failure


def test_parameters_cannot_be_changed_under_a_configured_node(configured):
    node, _ = configured()
    (answer,) = node.set_parameters([Parameter('samples', value=8)])
    assert not answer.successful
    assert node.get_parameter('samples').value == 40
