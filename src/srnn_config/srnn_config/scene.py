# SPDX-License-Identifier: Apache-2.0
"""Scene files: way points, obstacles and noise in metres of `srnn_workspace`."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from srnn_config.convex import MUST, is_convex
from srnn_config.errors import ParameterError, UnknownKeyError
from srnn_config.fields import Parameters, parameter
from srnn_config.loading import build, read_yaml

EDGE = 0.30
"""Half the side of the square workspace [m]; scenes must lie inside."""

NEVER = 1_000_000_000
"""Segment number that no run reaches: an obstacle that never disappears."""

_SHAPE_KEYS = {
    'box': ('size', 'yaw'),
    'disc': ('radius',),
    'polygon': ('points', 'yaw'),
}


@dataclass(frozen=True)
class Obstacle:
    """One upright, convex obstacle; lengths are metres in `srnn_workspace`.

    It stands there from segment `appears_at` until before `disappears_at`. The planner
    is told of it if it is `known`, and has to learn it otherwise.
    """

    shape: str
    center: tuple[float, float]
    size: tuple[float, float] = (0.0, 0.0)
    radius: float = 0.0
    points: tuple[tuple[float, float], ...] = ()
    yaw: float = 0.0
    appears_at: int = 0
    disappears_at: int = NEVER
    known: bool = False

    def present(self, segment: int) -> bool:
        """Tell whether the obstacle stands in the way during segment number `segment`."""
        return self.appears_at <= segment < self.disappears_at


@dataclass(frozen=True)
class SceneNoise(Parameters):
    """Noise that the scene adds to the sensors of the simulated arm."""

    position: float = parameter(
        2e-5, unit='rad', minimum=0.0, maximum=0.01,
        doc='Standard deviation of the measured joint positions.',
    )
    torque: float = parameter(
        0.2, unit='Nm', minimum=0.0, maximum=5.0,
        doc='Standard deviation of the measured joint torques.',
    )


@dataclass(frozen=True)
class SceneTask(Parameters):
    """Scalar keys of a scene file."""

    name: str = parameter(doc='Name of the scene, used in reports.')
    reach_radius: float = parameter(
        0.06, unit='m', above=0.0, maximum=0.3,
        doc='A way point is reached when a segment ends closer than this.',
    )
    velocity: float = parameter(
        0.1, unit='m/s', above=0.0, maximum=0.2,
        doc='Speed at which segments are executed.',
    )
    blocked: int = parameter(
        0, minimum=0, doc='Index of the way point behind the obstacle, for the statistics.'
    )


@dataclass(frozen=True)
class Scene:
    """A task and a world; lengths in metres, frame `srnn_workspace`."""

    task: SceneTask
    waypoints: tuple[tuple[float, float], ...]
    obstacles: tuple[Obstacle, ...] = ()
    noise: SceneNoise = field(default_factory=SceneNoise)
    start: tuple[float, float] = (0.0, 0.0)


def load_scene(path: str | Path) -> Scene:
    """Read and check a scene file.

    Raises:
        ConfigFileError: the file cannot be read as YAML.
        UnknownKeyError: a key is unknown; the message lists the valid ones.
        ParameterError: a value is impossible.

    """
    return build_scene(read_yaml(path), str(path))


def build_scene(data: Mapping[str, Any], where: str) -> Scene:
    """Build a scene from plain data; see `load_scene` for the errors."""
    scalar = ('name', 'reach_radius', 'velocity', 'blocked')
    valid = (*scalar, 'waypoints', 'obstacles', 'noise', 'start')
    for key in data:
        if key not in valid:
            raise UnknownKeyError(where, key, valid)
    task = build(SceneTask, {k: data[k] for k in scalar if k in data}, where)
    waypoints = _points(data.get('waypoints'), f'{where}.waypoints', at_least=1)
    if task.blocked >= len(waypoints):
        raise ParameterError(
            f'{where}.blocked = {task.blocked}: must be an index of the '
            f'{len(waypoints)} way points, 0 to {len(waypoints) - 1}'
        )
    obstacles = data.get('obstacles') or []
    if not isinstance(obstacles, list):
        raise ParameterError(f'{where}.obstacles: must be a list, not {obstacles!r}')
    return Scene(
        task=task,
        waypoints=waypoints,
        obstacles=tuple(
            _obstacle(item, f'{where}.obstacles[{i}]') for i, item in enumerate(obstacles)
        ),
        noise=build(SceneNoise, data.get('noise') or {}, f'{where}.noise'),
        start=_point(data.get('start', waypoints[0]), f'{where}.start'),
    )


def _obstacle(data: Any, where: str) -> Obstacle:
    if not isinstance(data, Mapping):
        raise ParameterError(f'{where}: must be a mapping, not {data!r}')
    shape = data.get('shape')
    if shape not in _SHAPE_KEYS:
        raise ParameterError(f'{where}.shape = {shape!r}: must be one of {", ".join(_SHAPE_KEYS)}')
    valid = ('shape', 'center', 'appears_at', 'disappears_at', 'known', *_SHAPE_KEYS[shape])
    for key in data:
        if key not in valid:
            raise UnknownKeyError(where, key, valid)
    appears = _whole(data.get('appears_at', 0), f'{where}.appears_at')
    disappears = _whole(data.get('disappears_at', NEVER), f'{where}.disappears_at')
    if disappears <= appears:
        raise ParameterError(
            f'{where}.disappears_at = {disappears}: must be > appears_at = {appears}'
        )
    known = data.get('known', False)
    if not isinstance(known, bool):
        raise ParameterError(f'{where}.known = {known!r}: must be true or false')
    common: dict[str, Any] = {
        'known': known,
        'shape': shape,
        'center': _point(data.get('center', (0.0, 0.0)), f'{where}.center'),
        'yaw': _number(data.get('yaw', 0.0), f'{where}.yaw', -6.3, 6.3),
        'appears_at': appears,
        'disappears_at': disappears,
    }
    if shape == 'disc':
        radius = _number(data.get('radius'), f'{where}.radius', 0.002, EDGE)
        return Obstacle(**common, radius=radius)
    if shape == 'box':
        size = _point(data.get('size'), f'{where}.size', low=0.004, high=2 * EDGE)
        return Obstacle(**common, size=size)
    points = _points(data.get('points'), f'{where}.points', at_least=3)
    if not is_convex(np.array(points)):
        raise ParameterError(f'{where}.points = {[list(point) for point in points]}: {MUST}')
    return Obstacle(**common, points=points)


def _points(data: Any, where: str, at_least: int) -> tuple[tuple[float, float], ...]:
    if not isinstance(data, (list, tuple)) or len(data) < at_least:
        raise ParameterError(f'{where} = {data!r}: must be a list of at least {at_least} [x, y]')
    return tuple(_point(item, f'{where}[{i}]') for i, item in enumerate(data))


def _point(data: Any, where: str, low: float = -EDGE, high: float = EDGE) -> tuple[float, float]:
    if not isinstance(data, (list, tuple)) or len(data) != 2:
        raise ParameterError(f'{where} = {data!r}: must be two numbers [x, y] in metres')
    return (_number(data[0], where, low, high), _number(data[1], where, low, high))


def _number(data: Any, where: str, low: float, high: float) -> float:
    number = isinstance(data, (int, float)) and not isinstance(data, bool)
    if not number or not low <= data <= high:
        raise ParameterError(f'{where} = {data!r}: must be a number from {low:g} to {high:g}')
    return float(data)


def _whole(data: Any, where: str) -> int:
    if not isinstance(data, int) or isinstance(data, bool) or data < 0:
        raise ParameterError(f'{where} = {data!r}: must be a whole number >= 0')
    return data
