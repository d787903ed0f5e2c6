# SPDX-License-Identifier: Apache-2.0
"""Commands of FRI 1.0, written from the published offsets."""

import numpy as np

WORD, COUNT, FLOAT, INTEGER = '<u2', '<u4', '<f4', '<i4'

ORDERED = {
    'ints': (72, INTEGER, 16), 'flags': (140, COUNT, 1), 'position': (144, FLOAT, 7),
    'torque': (220, FLOAT, 7), 'stiffness': (272, FLOAT, 7), 'damping': (300, FLOAT, 7),
}  # fmt: skip


def command(sequence=0x0304, reflected=0x0102, **fields):
    """Return the datagram with the given fields, the others 0."""
    data = np.zeros(376, np.uint8)
    data[:8] = np.array([sequence, reflected, 376, 0x1005], WORD).view(np.uint8)
    for name, values in fields.items():
        offset, kind, count = ORDERED[name]
        raw = np.full(count, values, kind).view(np.uint8)
        data[offset : offset + len(raw)] = raw
    return data.tobytes()
