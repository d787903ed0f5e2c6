# SPDX-License-Identifier: Apache-2.0
"""One obstacle of a scene as a MuJoCo geometry."""

from math import cos, sin

import mujoco
import numpy as np
from numpy.typing import NDArray

from lwr_description import Mount
from lwr_sim_bridge.errors import SceneShapeError
from lwr_sim_bridge.parameters import ContactParameters
from srnn_config.convex import MUST, is_convex
from srnn_config.scene import Obstacle

TOP = 0.01
"""Height of the top of a post above the working plane [m]: low, so that a tilted tool rod
touches it near the tip."""

BOTTOM = -0.06
"""Height of the foot of a post, and of the table it stands on, above the plane [m]."""


def add_obstacle(
    spec: mujoco.MjSpec, obstacle: Obstacle, name: str, mount: Mount, contact: ContactParameters
) -> None:
    """Add an upright post with the outline of `obstacle` to the world of `spec`.

    Args:
        spec: model to add to.
        obstacle: outline in `srnn_workspace` [m].
        name: name of the new geometry.
        mount: places the frame `srnn_workspace` in the world.
        contact: stiffness and friction of the surface.

    Raises:
        SceneShapeError: a polygon is not convex.

    """
    x, y = obstacle.center
    geom = spec.worldbody.add_geom(
        name=name,
        pos=[mount.plane_x + x, y, mount.plane_z + (TOP + BOTTOM) / 2],
        quat=[cos(obstacle.yaw / 2), 0.0, 0.0, sin(obstacle.yaw / 2)],
        solref=[contact.time_constant, 1.0],
        friction=[contact.friction, 0.0, 0.0],
        priority=1,
        rgba=[0.55, 0.12, 0.12, 1.0],
    )
    half_height = (TOP - BOTTOM) / 2
    if obstacle.shape == 'box':
        geom.type = mujoco.mjtGeom.mjGEOM_BOX
        geom.size = [obstacle.size[0] / 2, obstacle.size[1] / 2, half_height]
    elif obstacle.shape == 'disc':
        geom.type = mujoco.mjtGeom.mjGEOM_CYLINDER
        geom.size = [obstacle.radius, half_height, 0.0]
    else:
        outline = np.array(obstacle.points)
        if not is_convex(outline):
            raise SceneShapeError(f'{name}: points = {outline.tolist()}: {MUST}')
        spec.add_mesh(name=name, uservert=_prism(outline, half_height).ravel())
        geom.type = mujoco.mjtGeom.mjGEOM_MESH
        geom.meshname = name


def _prism(outline: NDArray[np.float64], half_height: float) -> NDArray[np.float64]:
    rings = [np.column_stack([outline, np.full(len(outline), z)]) for z in (-1.0, 1.0)]
    return np.concatenate(rings) * [1.0, 1.0, half_height]
