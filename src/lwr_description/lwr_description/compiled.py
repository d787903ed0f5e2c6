# SPDX-License-Identifier: Apache-2.0
"""Call what numba has compiled without numba's look at the arguments."""

from collections.abc import Callable
from typing import Any

import numba


def compiled(function: Any, *arguments: object) -> Callable[..., Any]:
    """Return a function of numba's, compiled for arguments of the types of these.

    What is returned never compiles and does not tell types apart, which takes longer than
    many a call: whoever calls it answers for types and layouts like those given here.
    """
    types = tuple(map(numba.typeof, arguments))
    function.compile(types)
    entry: Callable[..., Any] = function.get_overload(types)
    return entry
