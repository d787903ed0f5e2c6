# SPDX-License-Identifier: Apache-2.0
import numpy as np

from srnn_view.pictures import STEP, map_of, raster


def test_time_runs_to_the_right_and_neurons_down():
    spikes = np.zeros((4, 6), np.uint8)
    spikes[2, 5] = 7
    picture = raster(spikes)
    assert picture.shape == (6, 4 * STEP, 3)
    bright = picture.sum(axis=2) > picture[0, 0].sum()
    rows, columns = np.nonzero(bright)
    assert set(rows) == {5}
    assert set(columns) == set(range(2 * STEP, 3 * STEP))


def test_no_spikes_are_a_dark_picture():
    picture = raster(np.zeros((3, 2), np.uint8))
    assert (picture == picture[0, 0]).all()


def test_a_map_is_seen_from_above_and_hides_nothing_where_nothing_was_learned():
    inhibition = np.zeros((3, 5))
    inhibition[0, 4] = 1.0
    picture = map_of(inhibition, pixels=2)
    assert picture.shape == (6, 10, 4)
    rows, columns = np.nonzero(picture[..., 3])
    assert set(rows) == {4, 5}
    assert set(columns) == {8, 9}
