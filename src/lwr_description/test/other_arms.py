# SPDX-License-Identifier: Apache-2.0
"""Arms that are not the LWR 4+, as files that a test writes."""

from pathlib import Path

from lwr_description import ArmDescription, Mount

LINK = 0.3
"""Length of each of the two long links [m]."""

_MJCF = """
<mujoco>
  <option timestep="0.02" gravity="0 0 0" integrator="RK4"/>
  <worldbody>
    <geom type="plane" size="1 1 0.1"/>
    <body name="base" pos="0 0 0.5">
      <inertial mass="1" pos="0 0 0" diaginertia="0.01 0.01 0.01"/>
      <body name="shoulder" gravcomp="1">
        <inertial mass="1" pos="0 0 0" diaginertia="0.01 0.01 0.01"/>
        <joint name="pan" axis="0 0 1"/>
        <geom type="sphere" size="0.05"/>
        <body name="upper">
          <inertial mass="2" pos="0.15 0 0" diaginertia="0.01 0.01 0.01"/>
          <joint name="lift" axis="0 1 0"/>
          <body name="fore" pos="0.3 0 0">
            <inertial mass="1" pos="0.15 0 0" diaginertia="0.01 0.01 0.01"/>
            <joint name="elbow" axis="0 1 0"/>
            <body name="hand" pos="0.3 0 0">
              <inertial mass="0.5" pos="0 0 0" diaginertia="0.001 0.001 0.001"/>
              <joint name="wrist" axis="1 0 0"/>
              <body name="finger">
                <inertial mass="0.1" pos="0 0 0" diaginertia="0.001 0.001 0.001"/>
                <joint name="grip" type="slide" axis="0 1 0"/>
              </body>
            </body>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><position joint="grip" kp="10"/><position joint="lift" kp="10"/></actuator>
  <sensor><jointpos joint="lift"/></sensor>
  <keyframe><key qpos="0 0 0 0 0"/></keyframe>
</mujoco>
"""


def slim(folder: Path, mjcf: str = _MJCF, **changes) -> ArmDescription:
    """Describe an arm of four joints, none of whose limits lie evenly about zero."""
    path = folder / 'slim.xml'
    path.write_text(mjcf)
    told = {
        'model': str(path), 'joints': ('pan', 'lift', 'elbow', 'wrist'),
        'position_min': (-1.0, -2.0, 0.2, -3.0), 'position_max': (2.0, 0.5, 2.5, 1.0),
        'velocity_max': (1.0, 2.0, 3.0, 4.0), 'torque_max': (50.0, 60.0, 70.0, 80.0),
        'flange': 'hand', 'tool_origin': (0.05, 0.0, 0.0), 'tool_axis': (2.0, 0.0, 0.0),
    }  # fmt: skip
    return ArmDescription(**{**told, **changes})


def mounted(description: ArmDescription) -> Mount:
    """Stand it upright at the origin of the workspace, with 0.1 m of rod."""
    return Mount(
        base_height=0.0, pitch=0.0, plane_x=0.0, plane_z=0.0, tool_length=0.1,
        home=(0.3, -0.8, 1.2, 0.1), description=description,
    )  # fmt: skip
