# SPDX-License-Identifier: Apache-2.0
"""MuJoCo's C functions for code that numba compiles; every pointer is an address.

Compiled code finds them by name, so that it can be kept in numba's cache. Warnings are
counted in `mjData`; an error, which Python would see as an exception, ends the process.
"""

from pathlib import Path

from llvmlite.binding import load_library_permanently
import mujoco
from numba.types import ExternalFunction, int32, intp, void

# The file that the Python package has loaded already; this makes its names known.
load_library_permanently(str(next(Path(mujoco.__file__).parent.glob('libmujoco*'))))

mj_step = ExternalFunction('mj_step', void(intp, intp))
mj_kinematics = ExternalFunction('mj_kinematics', void(intp, intp))
mj_comPos = ExternalFunction('mj_comPos', void(intp, intp))  # noqa: N816
mj_comVel = ExternalFunction('mj_comVel', void(intp, intp))  # noqa: N816
mj_makeM = ExternalFunction('mj_makeM', void(intp, intp))  # noqa: N816
mj_fullM = ExternalFunction('mj_fullM', void(intp, intp, intp))  # noqa: N816
mj_rne = ExternalFunction('mj_rne', void(intp, intp, int32, intp))
mj_jacSite = ExternalFunction('mj_jacSite', void(intp, intp, intp, intp, int32))  # noqa: N816
