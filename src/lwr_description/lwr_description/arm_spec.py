# SPDX-License-Identifier: Apache-2.0
"""The arm with its tool, mounted in the world, as an editable MuJoCo model."""

from math import cos, sin
from pathlib import Path

import mujoco

from lwr_description.mount import Mount

MODELS = Path(__file__).parent / 'models'
"""Folder of the arm's model files."""

TIP_SITE = 'tip'
"""Site at the centre of the round end of the tool rod."""

WORKSPACE_SITE = 'srnn_workspace'
"""Site at the origin of the frame of the same name, axes parallel to the world."""

TOOL_GEOM = 'tool'
"""Geometry of the tool rod: the only part of the arm that may touch something."""


def arm_spec(mount: Mount) -> mujoco.MjSpec:
    """Build the mounted arm; add a scene to the result, then compile it.

    The tip is the *centre* of the rod's round end: whatever touches the round end pushes
    through the tip, from every side at the distance `mount.tool_radius`.

    Args:
        mount: pose of the base, working plane and tool.

    Returns:
        Specification with seven motors in FRI order and signs [Nm], the sites `TIP_SITE` and
        `WORKSPACE_SITE`, and the tool as body and geometry `TOOL_GEOM`.

    """
    spec = mujoco.MjSpec.from_file(str(MODELS / 'lwr4p.xml'))
    base = spec.body('lwr_base')
    base.pos = [0.0, 0.0, mount.base_height]
    base.quat = [cos(mount.pitch / 2), 0.0, sin(mount.pitch / 2), 0.0]
    _add_tool(spec.body('link7'), mount)
    spec.worldbody.add_site(name=WORKSPACE_SITE, pos=[mount.plane_x, 0.0, mount.plane_z])
    return spec


def _add_tool(flange: mujoco.MjsBody, mount: Mount) -> None:
    tool = flange.add_body(name=TOOL_GEOM)
    tool.add_geom(
        name=TOOL_GEOM,
        type=mujoco.mjtGeom.mjGEOM_CAPSULE,
        fromto=[0.0, 0.0, 0.0, 0.0, 0.0, mount.tool_length],
        size=[mount.tool_radius, 0.0, 0.0],
        mass=mount.tool_mass,
        rgba=[0.3, 0.3, 0.35, 1.0],
    )
    tool.add_site(name=TIP_SITE, pos=[0.0, 0.0, mount.tool_length])
