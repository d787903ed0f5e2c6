# SPDX-License-Identifier: Apache-2.0
import struct

from synthetic_run import Player

from srnn_bringup.picture import DPI, SIZE, Story, draw
from srnn_planner.core.synapses import Synapses


def png_size(path):
    data = path.read_bytes()
    assert data[:8] == b'\x89PNG\r\n\x1a\n'
    return struct.unpack('>II', data[16:24])


def test_picture_of_a_run_has_its_size_and_shows_something(recorder, configuration, tmp_path):
    player = Player(recorder)
    player.touch((0.1, -0.1))
    for point in configuration.scene.waypoints:
        player.go(point)
    before = configuration.start_weights()
    weights = before.dense()
    weights[:, 100:110] -= 0.1
    after = Synapses.of(before.prior, weights)
    path = tmp_path / 'demo.png'
    draw(Story(configuration, recorder.records, before, after), path)
    assert png_size(path) == (round(SIZE[0] * DPI), round(SIZE[1] * DPI))
    empty = tmp_path / 'empty.png'
    draw(Story(configuration, [], before, before), empty)
    assert path.stat().st_size > 1.2 * empty.stat().st_size


def test_learning_ends_with_the_last_update(recorder, configuration):
    player = Player(recorder)
    for updated in (True, False, True, False, False):
        player.go((0.0, 0.0), updated=updated)
    weights = configuration.start_weights()
    assert Story(configuration, recorder.records, weights, weights).learned_until == 3
    assert Story(configuration, [], weights, weights).learned_until == 0
