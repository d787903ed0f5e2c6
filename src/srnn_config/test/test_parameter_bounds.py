# SPDX-License-Identifier: Apache-2.0
from dataclasses import FrozenInstanceError, dataclass
import math

from hypothesis import given
from hypothesis import strategies as st
import pytest

from srnn_config import ConfigError, ParameterError, Parameters, parameter

NUMBERS = st.floats(allow_nan=True, allow_infinity=True)


@dataclass(frozen=True)
class Bounded(Parameters):
    """One field per kind of bound."""

    closed: float = parameter(0.5, minimum=0.0, maximum=1.0, unit='m', doc='Closed interval.')
    open: float = parameter(1.0, above=0.0, doc='Open below.')
    free: float = parameter(0.0, doc='Any finite number.')
    count: int = parameter(3, minimum=1, maximum=9, doc='Whole number.')
    word: str = parameter('a', choices=('a', 'b'), doc='One of two.')
    flag: bool = parameter(False, doc='On or off.')
    pair: tuple[float, ...] = parameter((1.0, 2.0), length=2, minimum=0.0, doc='Two numbers.')
    names: tuple[str, ...] = parameter((), doc='Any number of texts.')


@dataclass(frozen=True)
class Range(Parameters):
    """Two fields that must fit each other."""

    low: float = parameter(0.0, doc='Lower end.')
    high: float = parameter(1.0, doc='Upper end.')

    def check(self):
        if self.high <= self.low:
            raise self.refuse('high', self.high, f'> low = {self.low:g}')


@given(NUMBERS)
def test_a_closed_interval_takes_its_ends_and_nothing_beyond(value):
    if 0.0 <= value <= 1.0:
        assert Bounded(closed=value).closed == value
    else:
        with pytest.raises(ParameterError, match=r'closed = .*: must be >= 0 and <= 1 \[m\]'):
            Bounded(closed=value)


@given(NUMBERS)
def test_an_open_interval_excludes_its_end(value):
    if 0.0 < value < math.inf:
        assert Bounded(open=value).open == value
    else:
        with pytest.raises(ParameterError, match=r'Bounded\.open = .*: must be > 0'):
            Bounded(open=value)


@given(NUMBERS)
def test_without_bounds_a_number_must_still_be_finite(value):
    if math.isfinite(value):
        assert Bounded(free=value).free == value
    else:
        with pytest.raises(ParameterError, match='must be finite'):
            Bounded(free=value)


@given(st.one_of(st.integers(-20, 20), st.floats(-20.0, 20.0)))
def test_whole_numbers_may_be_written_as_floats_but_not_with_a_fraction(value):
    if value == int(value) and 1 <= value <= 9:
        assert type(Bounded(count=value).count) is int
    else:
        with pytest.raises(ParameterError, match=r'count = .*>= 1 and <= 9'):
            Bounded(count=value)


@given(st.integers(-(10**6), 10**6))
def test_whole_numbers_are_welcome_where_floats_are_wanted(value):
    assert type(Bounded(free=value).free) is float


@pytest.mark.parametrize(
    ('field', 'value', 'complaint'),
    [
        ('closed', True, 'must be a number'),
        ('closed', '0.5', 'must be a number'),
        ('closed', None, 'must be a number'),
        ('count', False, 'must be a number'),
        ('word', 'c', "word = 'c': must be one of a, b"),
        ('word', 1, 'must be a text: one of a, b'),
        ('flag', 1, 'must be true or false'),
        ('flag', 'yes', 'must be true or false'),
        ('pair', (1.0,), 'must be 2 values, each >= 0'),
        ('pair', (1.0, -1.0), 'must be 2 values, each >= 0'),
        ('pair', (1.0, math.nan), 'must be 2 values, each >= 0'),
        ('pair', '12', 'must be a list'),
        ('pair', 1.0, 'must be a list'),
        ('names', (1,), 'must be a text'),
    ],
)
def test_wrong_types_are_refused_naming_field_value_and_choices(field, value, complaint):
    with pytest.raises(ParameterError) as caught:
        Bounded(**{field: value})
    assert f'Bounded.{field} = ' in str(caught.value)
    assert complaint in str(caught.value)


def test_lists_become_tuples_of_the_element_type():
    values = Bounded(pair=[1, 2], names=['p', 'q'])
    assert values.pair == (1.0, 2.0)
    assert all(type(item) is float for item in values.pair)
    assert values.names == ('p', 'q')


def test_rules_between_fields_are_checked_at_construction():
    assert Range(0.0, 0.1).high == 0.1
    with pytest.raises(ParameterError, match=r'Range\.high = 1\.0: must be > low = 2'):
        Range(low=2.0)


def test_a_parameter_set_cannot_be_changed():
    with pytest.raises(FrozenInstanceError):
        Bounded().count = 4


def test_a_refused_value_is_a_value_error_too():
    assert issubclass(ParameterError, ValueError)
    assert issubclass(ParameterError, ConfigError)
