# SPDX-License-Identifier: Apache-2.0
"""Both datagrams of FRI 1.0, written byte by byte from the published offsets."""

import struct

MEASUREMENT = {
    'head.sequence': (0, 'H', 1), 'head.reflected': (2, 'H', 1),
    'head.size': (4, 'H', 1), 'head.datagram_id': (6, 'H', 1),
    'exchange.reals': (8, 'f', 16), 'exchange.ints': (72, 'i', 16),
    'exchange.bools': (136, 'H', 1), 'exchange.fill': (138, 'H', 1),
    'interface.timestamp': (140, 'f', 1), 'interface.state': (144, 'H', 1),
    'interface.quality': (146, 'H', 1), 'interface.measurement_period': (148, 'f', 1),
    'interface.command_period': (152, 'f', 1), 'interface.safety_limits': (156, 'f', 1),
    'statistics.answer_rate': (160, 'f', 1), 'statistics.latency': (164, 'f', 1),
    'statistics.jitter': (168, 'f', 1), 'statistics.miss_rate': (172, 'f', 1),
    'statistics.misses': (176, 'I', 1), 'robot.power': (180, 'H', 1),
    'robot.control': (182, 'H', 1), 'robot.error': (184, 'H', 1), 'robot.warning': (186, 'H', 1),
    'robot.temperature': (188, 'f', 7), 'data.joint_position': (216, 'f', 7),
    'data.pose': (244, 'f', 12), 'data.commanded_joint_position': (292, 'f', 7),
    'data.joint_offset': (320, 'f', 7), 'data.commanded_pose': (348, 'f', 12),
    'data.pose_offset': (396, 'f', 12), 'data.joint_torque': (444, 'f', 7),
    'data.external_torque': (472, 'f', 7), 'data.tool_wrench': (500, 'f', 6),
    'data.jacobian': (524, 'f', 42), 'data.mass_matrix': (692, 'f', 49),
    'data.gravity': (888, 'f', 7),
}  # fmt: skip

COMMAND = {
    'head.sequence': (0, 'H', 1), 'head.reflected': (2, 'H', 1),
    'head.size': (4, 'H', 1), 'head.datagram_id': (6, 'H', 1),
    'exchange.reals': (8, 'f', 16), 'exchange.ints': (72, 'i', 16),
    'exchange.bools': (136, 'H', 1), 'exchange.fill': (138, 'H', 1),
    'motion.flags': (140, 'I', 1), 'motion.joint_position': (144, 'f', 7),
    'motion.pose': (172, 'f', 12), 'motion.joint_torque': (220, 'f', 7),
    'motion.tool_wrench': (248, 'f', 6), 'motion.joint_stiffness': (272, 'f', 7),
    'motion.joint_damping': (300, 'f', 7), 'motion.stiffness': (328, 'f', 6),
    'motion.damping': (352, 'f', 6),
}  # fmt: skip

_BYTES = {'H': (2, False), 'I': (4, False), 'i': (4, True)}


def put(data, table, name, *values):
    """Write numbers into a datagram, least significant byte first."""
    offset, code, count = table[name]
    assert len(values) == count
    for value in values:
        if code == 'f':
            bits = int.from_bytes(struct.pack('>f', value), 'big')
            raw = [(bits >> shift) & 0xFF for shift in (0, 8, 16, 24)]
        else:
            size, signed = _BYTES[code]
            raw = list(int(value).to_bytes(size, 'little', signed=signed))
        data[offset : offset + len(raw)] = bytes(raw)
        offset += len(raw)


def distinct(table, words):
    """Return a value for every field, no two alike, all exact in float32."""
    values, number = {}, 1
    for name, (_, code, count) in table.items():
        sign = -1 if code in 'if' else 1
        step = 0.25 if code == 'f' else 1
        values[name] = [sign * step * (number + k) for k in range(count)]
        number += count
    values.update(words)
    return values


def written(table, values, size):
    data = bytearray(size)
    for name, numbers in values.items():
        put(data, table, name, *numbers)
    return bytes(data)


def measurement_values():
    return distinct(MEASUREMENT, {
        'head.size': [916], 'head.datagram_id': [0x2006], 'interface.state': [2],
        'interface.quality': [3], 'robot.control': [3],
    })  # fmt: skip
