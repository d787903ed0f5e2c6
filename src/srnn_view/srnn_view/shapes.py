# SPDX-License-Identifier: Apache-2.0
"""The arm, its table and its obstacles as meshes, and where the links are."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray
import trimesh

from lwr_description import Mount
from lwr_sim_bridge.parameters import ArmParameters, MismatchParameters
from lwr_sim_bridge.scene_model import SceneModel
from srnn_config.scene import Obstacle

_VISIBLE_GROUPS = 3
"""Geometries of groups from here on are no shapes for the eye."""


Placed = tuple[int, list[float], list[float]]
"""A link, its position [m] and its orientation (w, x, y, z)."""


@dataclass(frozen=True, eq=False)
class Shape:
    """One body part.

    Attributes:
        name: unique.
        link: index of the body that it belongs to, 0 for what does not move.
        vertices: (n, 3) in the frame of the body [m].
        faces: (m, 3) indices of vertices.
        colour: red, green, blue.
        obstacle: index of the obstacle that it is; None if it is none.

    """

    name: str
    link: int
    vertices: NDArray[np.float32]
    faces: NDArray[np.uint32]
    colour: tuple[int, int, int]
    obstacle: int | None


class SceneShapes:
    """The scene as the simulator has it.

    Attributes:
        shapes: everything that is to be seen.
        links: names of the bodies, the world first.

    """

    def __init__(self, mount: Mount, obstacles: Sequence[Obstacle]) -> None:
        """Build the scene.

        Raises:
            SceneShapeError: an obstacle cannot be built.

        """
        still = MismatchParameters(friction=(0.0,) * len(mount.home))
        scene = SceneModel(mount, ArmParameters(mismatch=still), obstacles)
        self._model, self._data = scene.model, scene.data
        self.links = tuple(self._model.body(i).name for i in range(self._model.nbody))
        self.shapes = tuple(_shapes(self._model))

    def place(self, joints: NDArray[np.float64]) -> Iterator[Placed]:
        """Yield where all is that moves.

        Args:
            joints: (n,) joint angles [rad].

        """
        self._data.qpos[:] = joints
        mujoco.mj_kinematics(self._model, self._data)
        for link in range(1, len(self.links)):
            yield link, self._data.xpos[link].tolist(), self._data.xquat[link].tolist()


def _shapes(model: mujoco.MjModel) -> Iterator[Shape]:
    for index in range(model.ngeom):
        if model.geom_group[index] >= _VISIBLE_GROUPS:
            continue
        mesh = _mesh(model, index)
        placed = np.eye(4)
        turn = np.empty(9)
        mujoco.mju_quat2Mat(turn, model.geom_quat[index])
        placed[:3, :3], placed[:3, 3] = turn.reshape(3, 3), model.geom_pos[index]
        mesh.apply_transform(placed)
        name = model.geom(index).name
        red, green, blue = (round(255.0 * float(c)) for c in model.geom_rgba[index, :3])
        yield Shape(
            name=f'{name or "part"}_{index}',
            link=int(model.geom_bodyid[index]),
            vertices=np.asarray(mesh.vertices, np.float32),
            faces=np.asarray(mesh.faces, np.uint32),
            colour=(red, green, blue),
            obstacle=int(name.removeprefix('obstacle_')) if name.startswith('obstacle_') else None,
        )


def _mesh(model: mujoco.MjModel, index: int) -> trimesh.Trimesh:
    """Return a geometry in its own frame."""
    kind, (a, b, c) = model.geom_type[index], model.geom_size[index].tolist()
    if kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        return trimesh.creation.cylinder(radius=a, height=2.0 * b, sections=32)
    if kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
        return trimesh.creation.capsule(radius=a, height=2.0 * b, count=(16, 16))
    if kind == mujoco.mjtGeom.mjGEOM_SPHERE:
        return trimesh.creation.icosphere(subdivisions=3, radius=a)
    if kind == mujoco.mjtGeom.mjGEOM_BOX:
        return trimesh.creation.box(extents=(2.0 * a, 2.0 * b, 2.0 * c))
    mesh = int(model.geom_dataid[index])
    first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
    side, sides = model.mesh_faceadr[mesh], model.mesh_facenum[mesh]
    return trimesh.Trimesh(
        model.mesh_vert[first : first + count], model.mesh_face[side : side + sides],
        process=False,
    )  # fmt: skip
