# SPDX-License-Identifier: Apache-2.0
"""What it costs to mark, seal and check messages, in time and in shares of a core.

Run: .venv/bin/python bench/access.py [--repeats N]

Every figure is the least of several rounds: others on the machine only ever add to it.
"""

import argparse
from collections.abc import Callable
import time
from typing import Any

import numpy as np
from rclpy.serialization import deserialize_message, serialize_message

from lwr_description import JOINT_NAMES
from srnn_access import Key, Source
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.ros import commands, joints, segment, weights
from srnn_msgs_py.segment import Segment
from srnn_msgs_py.topics import topic
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate
from srnn_node.inlet import Inlet
from srnn_node.outlet import Outlet

ROUNDS = 7
KNOTS, NEURONS, LEARNED = 40, 225, 4000
RATES = {
    'forward_position_controller/commands': 250.0,
    'joint_states': 250.0,
    'segment': 1.0,
    'weights': 0.1,
}
"""Messages per second, about."""


def message(name: str) -> Any:
    """Return a message as large as those of the demo."""
    rng = np.random.default_rng(1)
    angles = rng.random(7)
    if name == 'segment':
        points = rng.random((KNOTS, 2))
        return segment.to_msg(Segment(1, np.arange(KNOTS) / KNOTS, points, points, points))
    if name == 'weights':
        synapses = np.sort(rng.choice(NEURONS**2, LEARNED, replace=False))
        values = rng.random(LEARNED, dtype=np.float32)
        learned = LearnedWeights(NEURONS, 1, synapses, values)
        return weights.to_msg(WeightsUpdate(1, 1, learned))
    if name == 'joint_states':
        return joints.to_msgs(JointSample(1, angles, angles, angles, angles), JOINT_NAMES)[0]
    return commands.to_msg(angles)


def least_us(call: Callable[[int], object], repeats: int) -> float:
    """Return the time of one call [us], the least mean of several rounds."""
    means = []
    for _ in range(ROUNDS):
        began = time.perf_counter()
        for n in range(repeats):
            call(n)
        means.append(1e6 * (time.perf_counter() - began) / repeats)
    return min(means)


def costs(name: str, key: Key | None, repeats: int) -> tuple[float, float]:
    """Return what a message costs its sender and its listener [us]."""
    row, msg, source = topic(name), message(name), Source()
    outlet = Outlet(row, f'/{name}', source, key)

    def send(_: int) -> None:
        outlet.mark(msg, time.time_ns())
        outlet.unmark(msg)

    sending = least_us(send, repeats)
    checking = []
    for _ in range(ROUNDS):
        inlet, arrived, signed_ns = Inlet(row, f'/{name}', key), [], time.time_ns()
        for _ in range(repeats):
            outlet.mark(msg, signed_ns)
            arrived.append(deserialize_message(serialize_message(msg), type(msg)))
            outlet.unmark(msg)
        began = time.perf_counter()
        for one in arrived:
            assert inlet.judge(one, time.monotonic(), signed_ns) is None
        checking.append(1e6 * (time.perf_counter() - began) / repeats)
    return sending, min(checking)


def main() -> None:
    """Print a table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--repeats', type=int, default=200, help='calls per round (default 200)')
    repeats = parser.parse_args().repeats
    print('| topic | at | sender, mark | listener, mark | sender, seal | listener, seal |')
    print('|---|---|---|---|---|---|')
    for name, rate in RATES.items():
        cells = []
        for key in (None, Key.random()):
            for us in costs(name, key, repeats):
                cells.append(f'{us:.1f} us, {1e-4 * us * rate:.2g} %')
        if not topic(name).ownership.always:
            cells[:2] = ['', '']
        print(f'| `{name}` | {rate:g} Hz | {" | ".join(cells)} |')


if __name__ == '__main__':
    main()
