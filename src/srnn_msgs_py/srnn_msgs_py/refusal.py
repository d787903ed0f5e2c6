# SPDX-License-Identifier: Apache-2.0
"""The planner's word that nothing can be planned with a version of the weights."""

from dataclasses import dataclass


@dataclass(frozen=True)
class WeightsRefusal:
    """Weights that the planner has left, and why.

    Attributes:
        refused_version: version under which no valid plan was found.
        good_version: version that the planner has gone back to; 0 is the prior.
        reason: cause in words.

    """

    refused_version: int
    good_version: int
    reason: str
