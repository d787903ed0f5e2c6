# SPDX-License-Identifier: Apache-2.0
"""The scene in three dimensions: arm, plan and path, samples, way points, belief."""

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray
import viser

from lwr_description import Mount
from srnn_config.scene import Obstacle
from srnn_view.live_run import LiveRun, Part, Waypoint
from srnn_view.pictures import map_of
from srnn_view.shapes import SceneShapes

Colour = tuple[int, int, int]

PLAN: Colour = (30, 100, 220)
EXECUTED: Colour = (20, 20, 20)
KEPT: Colour = (60, 170, 90)
REJECTED: Colour = (190, 190, 190)
NEXT: Colour = (230, 100, 30)
RESTING: Colour = (60, 100, 200)

_ABOVE = 0.012
"""Lines run this high above the plane, so that the map and the posts do not hide them [m]."""

_ON_TABLE = -0.058
"""Height of the map of the belief, just above the table [m]."""

_CAMERA = np.array([1.3, -0.9, 0.8])
"""Where the page is seen from, from the middle of the plane [m]."""

_LOOK = np.array([-0.2, 0.0, 0.25])
"""Where it looks, from there [m]."""

_CELL_PIXELS = 8
_NOTHING = np.zeros((1, 2, 3), np.float32)
"""Lines must not be empty; one without length is not to be seen."""


class Stage:
    """Draws a run into the scene of a page."""

    def __init__(
        self, server: viser.ViserServer, mount: Mount, obstacles: Sequence[Obstacle]
    ) -> None:
        """Put up what does not change: the shapes of everything."""
        self._scene = scene = server.scene
        middle = np.array([mount.plane_x, 0.0, mount.plane_z])
        server.initial_camera.position = middle + _CAMERA
        server.initial_camera.look_at = middle + _LOOK
        self._obstacles = obstacles
        self._shapes = SceneShapes(mount, obstacles)
        scene.set_up_direction('+z')
        scene.add_frame('/links', show_axes=False)
        self._links = [
            scene.add_frame(f'/links/{index}', show_axes=False)
            for index in range(len(self._shapes.links))
        ]
        self._posts = {}
        for shape in self._shapes.shapes:
            mesh = scene.add_mesh_simple(
                f'/links/{shape.link}/{shape.name}', shape.vertices, shape.faces,
                color=shape.colour,
            )
            if shape.obstacle is not None:
                self._posts[shape.obstacle] = mesh
        scene.add_frame('/plane', show_axes=False, position=middle)
        self._plan = self._lines('plan', PLAN, 0.004)
        self._executed = self._lines('executed', EXECUTED, 0.003)
        self._kept = self._lines('kept', KEPT, 0.0015)
        self._rejected = self._lines('rejected', REJECTED, 0.0008)
        self._waypoints: list[viser.CylinderHandle] = []

    def draw(self, run: LiveRun, changed: Iterable[Part]) -> None:
        """Bring the scene up to date."""
        draw = {
            Part.ARM: self._draw_arm,
            Part.PLAN: self._draw_plan,
            Part.EXECUTED: self._draw_executed,
            Part.SAMPLES: self._draw_samples,
            Part.WAYPOINTS: self._draw_waypoints,
            Part.BELIEF: self._draw_belief,
            Part.COUNTS: self._draw_posts,
        }
        for part in changed:
            if part in draw:
                draw[part](run)

    def _lines(self, name: str, colour: Colour, thickness: float) -> viser.LineSegmentsHandle:
        return self._scene.add_line_segments(
            f'/plane/{name}', _NOTHING, colour, thickness=thickness, position=(0.0, 0.0, _ABOVE)
        )

    def _draw_arm(self, run: LiveRun) -> None:
        if run.joints is None:
            return
        for link, position, orientation in self._shapes.place(run.joints):
            self._links[link].position = np.array(position)
            self._links[link].wxyz = np.array(orientation)

    def _draw_plan(self, run: LiveRun) -> None:
        self._plan.points = _pieces([] if run.plan is None else [run.plan])

    def _draw_executed(self, run: LiveRun) -> None:
        self._executed.points = _pieces(run.executed)

    def _draw_samples(self, run: LiveRun) -> None:
        samples = () if run.samples is None else run.samples
        self._kept.points = _pieces(samples[: run.kept])
        self._rejected.points = _pieces(samples[run.kept :])

    def _draw_waypoints(self, run: LiveRun) -> None:
        for mesh in self._waypoints:
            mesh.remove()
        self._waypoints = [self._waypoint(i, point) for i, point in enumerate(run.waypoints)]

    def _waypoint(self, index: int, point: Waypoint) -> viser.CylinderHandle:
        return self._scene.add_cylinder(
            f'/plane/waypoint_{index}', point.radius, 0.002,
            NEXT if point.active else RESTING, opacity=0.6,
            position=(*point.position, 0.0),
        )  # fmt: skip

    def _draw_belief(self, run: LiveRun) -> None:
        belief = run.belief
        if belief is None:
            return
        rows, columns = belief.inhibition.shape
        width, height = columns * belief.cell, rows * belief.cell
        x, y = belief.corner
        self._scene.add_image(
            '/plane/belief', map_of(belief.inhibition, _CELL_PIXELS), width, height,
            # Pictures hang face to +z with their first row at -y.
            wxyz=(0.0, 1.0, 0.0, 0.0),
            position=(x + width / 2.0, y + height / 2.0, _ON_TABLE),
        )  # fmt: skip

    def _draw_posts(self, run: LiveRun) -> None:
        for index, mesh in self._posts.items():
            mesh.visible = self._obstacles[index].present(run.ended)


def _pieces(paths: Iterable[NDArray[np.float32] | NDArray[np.float64]]) -> NDArray[np.float32]:
    """Return paths (n, 2 or 3) as pieces of straight lines (m, 2, 3)."""
    pieces = [_NOTHING]
    for path in paths:
        points = np.zeros((len(path), 3), np.float32)
        points[:, : path.shape[1]] = path
        pieces.append(np.stack([points[:-1], points[1:]], axis=1))
    return np.concatenate(pieces)
