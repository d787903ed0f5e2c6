# SPDX-License-Identifier: Apache-2.0
"""Both datagrams against bytes written by hand."""

from contextlib import suppress
from dataclasses import dataclass, replace
from operator import attrgetter

from golden import COMMAND, MEASUREMENT, distinct, measurement_values, put, written
from hypothesis import given
from hypothesis import strategies as st
import pytest

from lwr_fri_driver.core import command as command_module
from lwr_fri_driver.core import measurement as measurement_module
from lwr_fri_driver.core.command import Motion, encode
from lwr_fri_driver.core.datagram import Exchange, Head
from lwr_fri_driver.core.layout import Layout, wire
from lwr_fri_driver.core.measurement import decode
from lwr_fri_driver.core.words import Control, FriState, Quality
from lwr_fri_driver.errors import DatagramError


def plain(value):
    return list(value) if isinstance(value, tuple) else [getattr(value, 'value', value)]


def test_every_field_of_a_measurement_is_read_from_its_own_place():
    values = measurement_values()
    measurement = decode(written(MEASUREMENT, values, 916))
    for name, numbers in values.items():
        assert plain(attrgetter(name)(measurement)) == numbers, name
    assert measurement.interface.state is FriState.COMMAND
    assert measurement.interface.quality is Quality.PERFECT
    assert measurement.robot.control is Control.JOINT_IMPEDANCE
    assert set(measurement_module.LAYOUT.places) == set(MEASUREMENT)


def test_every_field_of_a_command_is_written_to_its_own_place():
    values = distinct(COMMAND, {'head.size': [376], 'head.datagram_id': [0x1005]})
    packed = encode(
        *values['head.sequence'],
        *values['head.reflected'],
        Exchange(
            tuple(values['exchange.reals']), tuple(values['exchange.ints']),
            *values['exchange.bools'], *values['exchange.fill'],
        ),
        Motion(*values['motion.flags'], *(
            tuple(values[name]) for name in list(COMMAND) if name.startswith('motion.')
            and name != 'motion.flags'
        )),
    )  # fmt: skip
    assert packed == written(COMMAND, values, 376)
    assert set(command_module.LAYOUT.places) == set(COMMAND)


def test_the_first_bytes_are_those_of_the_wire():
    motion = Motion(flags=0x0035, joint_position=(1.0, -2.0, 0.5, 0.0, 0.0, 0.0, 0.0))
    packed = encode(0x0102, 0xFFFE, Exchange(bools=0x8001), motion)
    assert len(packed) == 376
    assert packed[:8].hex(' ') == '02 01 fe ff 78 01 05 10'
    assert packed[136:144].hex(' ') == '01 80 00 00 35 00 00 00'
    assert packed[144:156].hex(' ') == '00 00 80 3f 00 00 00 c0 00 00 00 3f'


def test_where_the_controller_heads_for_is_its_command_and_the_offset_of_fri():
    values = measurement_values() | {
        'data.commanded_joint_position': [0.25] * 7, 'data.joint_offset': [0.5, *[0.0] * 6],
    }  # fmt: skip
    assert decode(written(MEASUREMENT, values, 916)).target == (0.75, *[0.25] * 6)


@given(st.binary(max_size=2000))
def test_any_bytes_are_a_measurement_or_a_named_error(data):
    with suppress(DatagramError):
        assert decode(data).head.datagram_id == 0x2006


@given(st.binary(min_size=916, max_size=916))
def test_no_packet_of_the_right_size_breaks_the_reader(data):
    data = bytearray(data)
    put(data, MEASUREMENT, 'head.size', 916)
    put(data, MEASUREMENT, 'head.datagram_id', 0x2006)
    for name in ('interface.state', 'interface.quality', 'robot.control'):
        put(data, MEASUREMENT, name, 1)
    assert decode(bytes(data)).interface.state is FriState.MONITOR


@pytest.mark.parametrize(('name', 'value', 'message'), [
    ('head.datagram_id', 0x2005, 'datagram 0x2005 of 916 bytes: must be 0x2006 of 916'),
    ('head.size', 376, 'datagram 0x2006 of 376 bytes: must be 0x2006 of 916'),
    ('interface.state', 3,
     'state = 3: must be one of 0 OFF, 1 MONITOR, 2 COMMAND, 65535 INVALID'),
    ('interface.quality', 4, 'quality = 4: must be one of 0 UNACCEPTABLE, 1 BAD, 2 OK, '
     '3 PERFECT, 65535 INVALID'),
    ('robot.control', 9, 'control = 9: must be one of 0 OTHER, 1 POSITION, '
     '2 CARTESIAN_IMPEDANCE, 3 JOINT_IMPEDANCE'),
])  # fmt: skip
def test_a_foreign_packet_is_named(name, value, message):
    data = written(MEASUREMENT, measurement_values() | {name: [value]}, 916)
    with pytest.raises(DatagramError) as caught:
        decode(data)
    assert str(caught.value) == message


@pytest.mark.parametrize('size', [0, 8, 376, 915, 917])
def test_another_size_is_named(size):
    with pytest.raises(DatagramError, match=f'Measurement: {size} bytes: must be 916'):
        decode(written(MEASUREMENT, measurement_values(), 916)[:size].ljust(size, b'\0'))


@pytest.mark.parametrize('motion', [
    Motion(joint_position=(0.0,) * 6),
    Motion(joint_position=(1e300, *[0.0] * 6)),
    Motion(flags=-1),
])  # fmt: skip
def test_what_does_not_fit_is_never_sent(motion):
    with pytest.raises(DatagramError, match='Command'):
        encode(0, 0, Exchange(), motion)


def test_a_gap_an_overlap_and_a_wrong_size_are_found_when_the_layout_is_made():
    @dataclass(frozen=True)
    class Gap:
        first: int = wire(0, 'H')
        second: int = wire(4, 'H')

    @dataclass(frozen=True)
    class Overlap:
        first: float = wire(0, 'f', 2)
        second: int = wire(4, 'H')

    with pytest.raises(DatagramError, match='second: offset 4: must be 2'):
        Layout(Gap, 6)
    with pytest.raises(DatagramError, match='second: offset 4: must be 8'):
        Layout(Overlap, 10)
    with pytest.raises(DatagramError, match='Head: the fields have 8 bytes: must be 10'):
        Layout(Head, 10)


def test_values_cannot_be_changed():
    measurement = decode(written(MEASUREMENT, measurement_values(), 916))
    with pytest.raises(AttributeError):
        measurement.head.sequence = 1
    assert replace(measurement.head, sequence=1).sequence == 1
