# SPDX-License-Identifier: Apache-2.0
"""What the paper reports (Tanneberg, Peters and Rueckert, Neural Networks 2019)."""

from dataclasses import dataclass

MeanSd = tuple[float, float]

TRANSFER_CONTACTS, TRANSFER_FIRST_TOUCH = 7, 15
"""One trial of the transfer to the real arm: contacts with the new obstacle until it was
learned, and the segment of the first. The obstacle known from simulation was not touched."""


@dataclass(frozen=True)
class PaperRow:
    """One row of Table 1, mean and standard deviation over 10 trials of 300 segments.

    Attributes:
        updates: segments that triggered learning.
        update_ms: time of an update with mental replay [ms].
        planning_ms: time to plan a segment [ms].
        execution_s: planned execution time of a segment [s].
        reached: visits of the blocked way point.

    """

    updates: MeanSd
    update_ms: MeanSd
    planning_ms: MeanSd
    execution_s: MeanSd
    reached: MeanSd


TABLE_1 = {
    'constant 0.001': PaperRow(
        (7.3, 1.1), (42.6, 4.2), (238.0, 47.0), (0.898, 0.656), (10.5, 0.5)
    ),
    'constant 0.01': PaperRow(
        (2.4, 0.5), (43.7, 4.2), (237.0, 46.0), (0.806, 0.652), (8.5, 3.2)
    ),
    'constant 0.1': PaperRow(
        (2.0, 0.0), (46.7, 5.7), (234.0, 43.0), (0.771, 0.670), (7.9, 4.1)
    ),
    'global': PaperRow((2.8, 0.9), (43.3, 4.1), (241.0, 44.0), (0.928, 0.658), (10.4, 0.8)),
    'local': PaperRow((8.6, 2.8), (52.6, 7.5), (235.0, 42.0), (1.11, 0.679), (13.7, 1.4)),
}
"""By the names of our rows; the paper has none without learning, and none without trigger."""

LARGEST = 0.15
MASS_OF_LARGEST = {'global': 0.34, 'local': 0.30}
"""Share of the update mass that the largest 15 % of the learning signals cover."""
