# SPDX-License-Identifier: Apache-2.0
"""The plant: the arm as it really is, and the obstacles of the scene around its tool."""

from collections.abc import Sequence
from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from lwr_description import TOOL_GEOM, ModelError, Mount, arm_spec
from lwr_sim_bridge.obstacle_geom import BOTTOM, add_obstacle
from lwr_sim_bridge.parameters import ArmParameters, MismatchParameters
from srnn_config.scene import Obstacle


class SceneModel:
    """Compiled plant whose obstacles can be there or not.

    Attributes:
        model: MuJoCo model with a 1 ms time step; only the tool rod and obstacles that are
            there collide. Its only sensor counts the contacts of the tool.
        data: its state.
        tool: index of the tool's geometry.

    """

    def __init__(
        self, mount: Mount, parameters: ArmParameters, obstacles: Sequence[Obstacle]
    ) -> None:
        """Build and compile the plant, without any obstacle in it yet.

        Raises:
            SceneShapeError: the simulator cannot build an obstacle.
            DescriptionError: there is no model of the arm, or it is not of the arm described.

        """
        names = [f'obstacle_{i}' for i in range(len(obstacles))]
        spec = _mismatched_arm(mount, parameters.mismatch)
        _add_surroundings(spec, mount)
        for name, obstacle in zip(names, obstacles, strict=True):
            add_obstacle(spec, obstacle, name, mount, parameters.contact)
        _add_contact_counter(spec)
        self.model = spec.compile()
        self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
        self.data = mujoco.MjData(self.model)
        self.tool = self.model.geom(TOOL_GEOM).id
        self._obstacles = tuple(obstacles)
        self._geoms = [self.model.geom(name).id for name in names]
        self._pending: set[int] = set()
        self._segment = 0
        self._placed: dict[int, bool] = {}
        for geom in self._geoms:
            self._show(geom, False)

    def place(self, q: NDArray[np.float64]) -> None:
        """Put the arm at rest at the joint angles `q` (n,) [rad]."""
        self.data.qpos = q
        mujoco.mj_forward(self.model, self.data)

    def set_segment(self, segment: int) -> None:
        """Let the obstacles of segment number `segment` appear and the others vanish.

        An obstacle does not appear inside the tool: it waits for `settle` to find it clear.
        """
        self._segment = segment
        self._pending.clear()
        for index, obstacle in enumerate(self._obstacles):
            geom = self._geoms[index]
            if not self._placed.get(index, obstacle.present(segment)):
                self._show(geom, False)
            elif not self._shown(geom):
                self._pending.add(geom)
        self.settle()

    def set_obstacle(self, index: int, there: bool) -> None:
        """Put an obstacle there or take it away from now on, whatever the scene says."""
        self._placed[index] = there
        self.set_segment(self._segment)

    def settle(self) -> None:
        """Let waiting obstacles appear as soon as the tool is clear of them."""
        if not self._pending:
            return
        for geom in sorted(self._pending):
            if mujoco.mj_geomDistance(self.model, self.data, self.tool, geom, 1.0, None) > 0.0:
                self._show(geom, True)
                self._pending.discard(geom)

    @property
    def waiting(self) -> bool:
        """Tell whether `settle` has something to do."""
        return bool(self._pending)

    def present(self) -> tuple[int, ...]:
        """Return the indices of the obstacles that are there now."""
        return tuple(i for i, geom in enumerate(self._geoms) if self._shown(geom))

    def _show(self, geom: int, there: bool) -> None:
        self.model.geom_contype[geom] = there
        self.model.geom_conaffinity[geom] = there
        self.model.geom_rgba[geom, 3] = float(there)

    def _shown(self, geom: int) -> bool:
        return bool(self.model.geom_contype[geom])


def _mismatched_arm(mount: Mount, mismatch: MismatchParameters) -> mujoco.MjSpec:
    heavier = replace(mount, tool_mass=mount.tool_mass + mismatch.payload)
    spec = arm_spec(heavier)
    for name, friction in zip(mount.description.joints, mismatch.friction, strict=True):
        joint = spec.joint(name)
        joint.frictionloss = friction
        link = joint.parent
        if not link.explicitinertial:
            raise ModelError(f'body {link.name!r} of {mount.description.model}: has no inertial')
        link.mass = mismatch.mass_scale * link.mass
        # The file says one of the two.
        link.inertia = mismatch.mass_scale * np.array(link.inertia)
        link.fullinertia = mismatch.mass_scale * np.array(link.fullinertia)
    return spec


def _add_surroundings(spec: mujoco.MjSpec, mount: Mount) -> None:
    """Add what only the eye needs: light and the table that the posts stand on."""
    spec.worldbody.add_light(pos=[0.0, -1.0, 2.5], dir=[0.2, 0.4, -1.0])
    spec.worldbody.add_geom(
        name='table',
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=[mount.plane_x, 0.0, mount.plane_z + BOTTOM - 0.01],
        size=[0.35, 0.35, 0.01],
        contype=0,
        conaffinity=0,
        rgba=[0.85, 0.85, 0.82, 1.0],
    )


def _add_contact_counter(spec: mujoco.MjSpec) -> None:
    found = 1 << int(mujoco.mjtConDataField.mjCONDATA_FOUND)
    spec.add_sensor(
        name='contacts',
        type=mujoco.mjtSensor.mjSENS_CONTACT,
        objtype=mujoco.mjtObj.mjOBJ_GEOM,
        objname=TOOL_GEOM,
        intprm=[found, 0, 1],
    )
