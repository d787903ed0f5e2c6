# SPDX-License-Identifier: Apache-2.0
"""The emulator's own tables against the published offsets, byte by byte."""

from fri_command import COUNT, FLOAT, INTEGER, WORD, command
from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from lwr_sim_bridge.fri.wire import COMMAND, MEASUREMENT, Reading, pack, unpack

MEASURED = {
    'to_reals': (8, FLOAT, 16), 'to_ints': (72, INTEGER, 16), 'to_bools': (136, WORD, 1),
    'fill': (138, WORD, 1), 'timestamp': (140, FLOAT, 1), 'state': (144, WORD, 1),
    'quality': (146, WORD, 1), 'measurement_period': (148, FLOAT, 1),
    'command_period': (152, FLOAT, 1), 'safety_limits': (156, FLOAT, 1),
    'answer_rate': (160, FLOAT, 1), 'latency': (164, FLOAT, 1), 'jitter': (168, FLOAT, 1),
    'miss_rate': (172, FLOAT, 1), 'misses': (176, COUNT, 1), 'power': (180, WORD, 1),
    'control': (182, WORD, 1), 'error': (184, WORD, 1), 'warning': (186, WORD, 1),
    'temperature': (188, FLOAT, 7), 'position': (216, FLOAT, 7), 'pose': (244, FLOAT, 12),
    'commanded': (292, FLOAT, 7), 'offset': (320, FLOAT, 7), 'commanded_pose': (348, FLOAT, 12),
    'pose_offset': (396, FLOAT, 12), 'torque': (444, FLOAT, 7),
    'external_torque': (472, FLOAT, 7), 'tool_wrench': (500, FLOAT, 6),
    'jacobian': (524, FLOAT, 42), 'mass_matrix': (692, FLOAT, 49), 'gravity': (888, FLOAT, 7),
}  # fmt: skip

def test_sizes_are_those_of_fri_1_0():
    assert (MEASUREMENT.size, COMMAND.size) == (916, 376)


def test_every_number_of_a_measurement_is_where_it_belongs():
    assert tuple(MEASURED) == Reading._fields
    values, number = {}, 1
    for name, (_, kind, count) in MEASURED.items():
        numbers = np.arange(number, number + count) * (-0.5 if kind == FLOAT else 1)
        values[name] = numbers if count > 1 else numbers[0].item()
        number += count
    data = pack(0x0102, 0xFFFE, Reading(**values))
    assert data[:8] == bytes([2, 1, 0xFE, 0xFF, 0x94, 0x03, 0x06, 0x20])
    for name, (offset, kind, count) in MEASURED.items():
        assert (np.frombuffer(data, kind, count, offset) == values[name]).all(), name


def test_every_number_of_a_command_is_read_from_where_it_belongs():
    sent = {
        'ints': np.arange(1, 17) - 8, 'flags': 0x35, 'position': np.arange(7) * 0.25,
        'torque': np.arange(7) * 0.5 - 1, 'stiffness': 100.0 + np.arange(7),
        'damping': 0.5 + np.arange(7) / 16,
    }  # fmt: skip
    order = unpack(command(**sent))
    assert (order.sequence, order.reflected) == (0x0304, 0x0102)
    for name, values in sent.items():
        assert np.array_equal(getattr(order, name), values), name
    assert order.finite
    assert not unpack(command(stiffness=[1, 2, 3, np.nan, 5, 6, 7])).finite


@pytest.mark.parametrize('data', [
    b'', bytes(376), command()[:-1], command() + b'\0', bytes(916),
    command()[:6] + b'\x06\x20' + command()[8:],
])  # fmt: skip
def test_what_is_no_command_is_none(data):
    assert unpack(data) is None


@given(st.binary(max_size=400))
def test_garbage_is_none_or_a_command(data):
    order = unpack(data)
    assert order is None or len(data) == 376
