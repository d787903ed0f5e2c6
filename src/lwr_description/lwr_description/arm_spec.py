# SPDX-License-Identifier: Apache-2.0
"""The arm with its tool, mounted in the world, as an editable MuJoCo model."""

from math import cos, hypot, sin
from pathlib import Path

import mujoco

from lwr_description.description import ArmDescription
from lwr_description.errors import ModelError
from lwr_description.model_file import find_model
from lwr_description.mount import Mount

MODELS = Path(__file__).parent / 'models'
"""Folder of the model files of the LWR 4+."""

TIP_SITE = 'tip'
"""Site at the centre of the round end of the tool rod."""

WORKSPACE_SITE = 'srnn_workspace'
"""Site at the origin of the frame of the same name, axes parallel to the world."""

TOOL_GEOM = 'tool'
"""Geometry of the tool rod: the only part of the arm that may touch something."""

_GRAVITY = 9.80665


def arm_spec(mount: Mount) -> mujoco.MjSpec:
    """Build the mounted arm; add a scene to the result, then compile it.

    The tip is the *centre* of the rod's round end: whatever touches the round end pushes
    through the tip, from every side at the distance `mount.tool_radius`.

    Args:
        mount: which arm it is, pose of the base, working plane and tool.

    Returns:
        Specification with one motor per joint [Nm], both named as the joint and in the order
        of the description, the sites `TIP_SITE` and `WORKSPACE_SITE`, and the tool as body and
        geometry `TOOL_GEOM`. Of the model it keeps links, joints and shapes, nothing else.

    Raises:
        MissingModelError: there is no model file.
        ModelError: the model is not of the arm that is described.

    """
    description = mount.description
    spec = _read(description)
    _strip(spec)
    _set_physics(spec)
    _choose_joints(spec, description)
    _stand(spec, mount)
    _add_tool(spec, mount)
    spec.worldbody.add_site(name=WORKSPACE_SITE, pos=[mount.plane_x, 0.0, mount.plane_z])
    return spec


def _read(description: ArmDescription) -> mujoco.MjSpec:
    path = find_model(description.model)
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        raise ModelError(f'model = {description.model!r}: cannot be read: {error}') from error
    if path.suffix == '.urdf':
        _adapt_urdf(spec)
    return spec


def _adapt_urdf(spec: mujoco.MjSpec) -> None:
    # Links at fixed joints would vanish, with their names.
    spec.compiler.fusestatic = False
    # Meshes have paths of ROS, and often formats that MuJoCo cannot read; they are for the eye.
    for geom in spec.geoms:
        if geom.type == mujoco.mjtGeom.mjGEOM_MESH:
            spec.delete(geom)
    for mesh in spec.meshes:
        spec.delete(mesh)


def _strip(spec: mujoco.MjSpec) -> None:
    """Leave nothing that acts on the arm or touches it."""
    others = (
        *spec.actuators, *spec.sensors, *spec.tendons, *spec.equalities, *spec.keys, *spec.pairs,
        *spec.worldbody.geoms,
    )  # fmt: skip
    for element in others:
        spec.delete(element)
    for geom in spec.geoms:
        geom.contype = geom.conaffinity = 0
    for body in spec.bodies:
        body.gravcomp = 0.0


def _set_physics(spec: mujoco.MjSpec) -> None:
    option = spec.option
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.gravity = [0.0, 0.0, -_GRAVITY]


def _choose_joints(spec: mujoco.MjSpec, description: ArmDescription) -> None:
    there = [joint.name for joint in spec.joints]
    for joint in spec.joints:
        if joint.name not in description.joints:
            spec.delete(joint)
    kept = tuple(joint.name for joint in spec.joints)
    if kept != description.joints:
        raise ModelError(
            f'joints = {list(description.joints)}: must be joints of {description.model}, '
            f'in their order: {", ".join(there)}'
        )
    for joint, torque in zip(spec.joints, description.torque_max, strict=True):
        if joint.type != mujoco.mjtJoint.mjJNT_HINGE:
            raise ModelError(f'joints: {joint.name!r} of {description.model}: must be a hinge')
        motor = spec.add_actuator(
            name=joint.name, target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT,
            ctrllimited=True, ctrlrange=[-torque, torque],
        )  # fmt: skip
        motor.set_to_motor()


def _stand(spec: mujoco.MjSpec, mount: Mount) -> None:
    base = spec.worldbody.add_frame(
        pos=[0.0, 0.0, mount.base_height],
        quat=[cos(mount.pitch / 2), 0.0, sin(mount.pitch / 2), 0.0],
    )
    for body in spec.worldbody.bodies:
        body.set_frame(base)


def _add_tool(spec: mujoco.MjSpec, mount: Mount) -> None:
    description = mount.description
    flange = spec.body(description.flange)
    if flange is None:
        names = ', '.join(body.name for body in spec.bodies)
        raise ModelError(
            f'flange = {description.flange!r}: must be a body of {description.model}: {names}'
        )
    origin, axis = description.tool_origin, description.tool_axis
    length = mount.tool_length / hypot(*axis)
    tip = [start + length * part for start, part in zip(origin, axis, strict=True)]
    tool = flange.add_body(name=TOOL_GEOM)
    tool.add_geom(
        name=TOOL_GEOM,
        type=mujoco.mjtGeom.mjGEOM_CAPSULE,
        fromto=[*origin, *tip],
        size=[mount.tool_radius, 0.0, 0.0],
        mass=mount.tool_mass,
        rgba=[0.3, 0.3, 0.35, 1.0],
    )
    tool.add_site(name=TIP_SITE, pos=tip)
