# SPDX-License-Identifier: Apache-2.0
import struct

import numpy as np
import pytest
from synthetic_run import Player

from srnn_bringup.outline import outline
from srnn_bringup.picture import DPI, SIZE, Story, draw
from srnn_config.scene import Obstacle


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
    after = before.copy()
    after[:, 100:110] -= 0.1
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


@pytest.mark.parametrize(
    ('obstacle', 'area'),
    [
        (Obstacle('disc', (0.1, 0.0), radius=0.02), np.pi * 0.02**2),
        (Obstacle('box', (0.1, 0.0), size=(0.02, 0.04), yaw=0.7), 0.02 * 0.04),
        (Obstacle('polygon', (0.1, 0.0), points=((-0.01, -0.01), (0.02, -0.01), (-0.01, 0.02)),
                  yaw=2.0), 0.03 * 0.03 / 2.0),
    ],
)  # fmt: skip
def test_outlines_have_the_area_of_their_obstacle_and_surround_its_centre(obstacle, area):
    x, y = outline(obstacle).T
    shoelace = 0.5 * abs((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
    assert shoelace == pytest.approx(area, rel=0.01)
    assert min(x) < 0.1 < max(x)


def test_yaw_turns_to_the_left():
    corners = outline(Obstacle('box', (0.0, 0.0), size=(0.2, 0.0), yaw=np.pi / 2))
    assert np.abs(corners[:, 0]).max() < 1e-12
    turned = outline(Obstacle('polygon', (0.0, 0.0), points=((0.1, 0.0),) * 3, yaw=0.1))
    assert turned[0] == pytest.approx([0.1 * np.cos(0.1), 0.1 * np.sin(0.1)])
