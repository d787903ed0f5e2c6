# SPDX-License-Identifier: Apache-2.0
import copy

from hypothesis import given
from hypothesis import strategies as st
import pytest
import yaml

from srnn_config import ParameterError, UnknownKeyError
from srnn_config.scene import NEVER, Obstacle, build_scene, load_scene

SCENE = {
    'name': 'test',
    'waypoints': [[-0.1, 0.0], [0.2, 0.1], [0.0, 0.2]],
    'blocked': 1,
    'reach_radius': 0.05,
    'velocity': 0.12,
    'start': [0.0, -0.1],
    'noise': {'position': 0.0001},
    'obstacles': [
        {'shape': 'box', 'center': [0.1, 0.0], 'size': [0.1, 0.05], 'yaw': 0.3},
        {'shape': 'disc', 'center': [-0.2, 0.1], 'radius': 0.03, 'appears_at': 5, 'known': True},
        {'shape': 'polygon', 'points': [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]], 'disappears_at': 9},
    ],
}


def changed(path, value):
    """Return the scene with one entry replaced; `path` walks keys and indices."""
    data = copy.deepcopy(SCENE)
    place = data
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = value
    return data


def test_a_scene_file_is_read_completely(tmp_path):
    file = tmp_path / 'scene.yaml'
    file.write_text(yaml.safe_dump(SCENE))
    scene = load_scene(file)
    assert scene.task.name == 'test'
    assert (scene.task.blocked, scene.task.reach_radius, scene.task.velocity) == (1, 0.05, 0.12)
    assert scene.waypoints == ((-0.1, 0.0), (0.2, 0.1), (0.0, 0.2))
    assert scene.start == (0.0, -0.1)
    assert scene.noise.position == 0.0001
    box, disc, polygon = scene.obstacles
    assert (box.size, box.yaw, box.disappears_at) == ((0.1, 0.05), 0.3, NEVER)
    assert (disc.radius, disc.appears_at) == (0.03, 5)
    assert (box.known, disc.known) == (False, True)
    assert polygon.points == ((0.0, 0.0), (0.1, 0.0), (0.0, 0.1))


def test_a_scene_needs_a_name_and_way_points_only():
    scene = build_scene({'name': 'free', 'waypoints': [[0.1, 0.2]]}, 'scene')
    assert scene.obstacles == ()
    assert scene.start == (0.1, 0.2)


@pytest.mark.parametrize(
    ('path', 'complaint'),
    [
        (('waypoint',), "scene: unknown key 'waypoint' (did you mean 'waypoints'?)"),
        (('obstacles', 0, 'radius'), 'appears_at, disappears_at, known, size, yaw'),
        (('obstacles', 1, 'size'), "scene.obstacles[1]: unknown key 'size'"),
        (('noise', 'colour'), "scene.noise: unknown key 'colour'; valid keys: position, torque"),
    ],
)
def test_unknown_keys_are_refused_with_the_valid_ones(path, complaint):
    with pytest.raises(UnknownKeyError) as caught:
        build_scene(changed(path, 0.1), 'scene')
    assert complaint in str(caught.value)


@pytest.mark.parametrize(
    ('path', 'value', 'complaint'),
    [
        (('waypoints',), [], 'must be a list of at least 1'),
        (('waypoints',), None, 'must be a list'),
        (('waypoints', 1), [0.1], 'scene.waypoints[1] = [0.1]: must be two numbers'),
        (('waypoints', 1), [0.1, 0.31], 'must be a number from -0.3 to 0.3'),
        (('waypoints', 1), [0.1, float('nan')], 'must be a number from -0.3 to 0.3'),
        (('waypoints', 1), ['a', 0.1], 'must be a number'),
        (('blocked',), 3, 'must be an index of the 3 way points, 0 to 2'),
        (('blocked',), -1, 'must be >= 0'),
        (('velocity',), 0.25, 'velocity = 0.25: must be > 0 and <= 0.2 [m/s]'),
        (('reach_radius',), 0, 'reach_radius = 0.0: must be > 0'),
        (('start',), [1.0, 0.0], 'scene.start = 1.0'),
        (('obstacles',), {'shape': 'box'}, 'scene.obstacles: must be a list'),
        (('obstacles', 0), 'box', 'scene.obstacles[0]: must be a mapping'),
        (('obstacles', 0, 'shape'), 'ball', 'must be one of box, disc, polygon'),
        (('obstacles', 0, 'size'), [0.1, 0.0], 'must be a number from 0.004 to 0.6'),
        (('obstacles', 1, 'radius'), 0.0, 'must be a number from 0.002 to 0.3'),
        (('obstacles', 1, 'known'), 'yes', 'must be true or false'),
        (('obstacles', 1, 'appears_at'), -1, 'must be a whole number >= 0'),
        (('obstacles', 1, 'appears_at'), 1.5, 'must be a whole number >= 0'),
        (('obstacles', 1, 'disappears_at'), 5, 'must be > appears_at = 5'),
        (('obstacles', 2, 'points'), [[0.0, 0.0]], 'must be a list of at least 3'),
        (
            ('obstacles', 2, 'points'), [[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.05, 0.02]],
            'scene.obstacles[2].points = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.05, 0.02]]: '
            'must go once round a convex polygon',
        ),
    ],
)
def test_impossible_values_are_refused_with_their_place(path, value, complaint):
    with pytest.raises(ParameterError) as caught:
        build_scene(changed(path, value), 'scene')
    assert complaint in str(caught.value)


@given(st.integers(0, 100), st.integers(1, 100), st.integers(0, 250))
def test_an_obstacle_stands_from_its_first_segment_up_to_its_last(appears, length, segment):
    obstacle = Obstacle('disc', (0.0, 0.0), appears_at=appears, disappears_at=appears + length)
    assert obstacle.present(segment) == (segment in range(appears, appears + length))
