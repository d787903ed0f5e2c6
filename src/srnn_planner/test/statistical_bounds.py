# SPDX-License-Identifier: Apache-2.0
"""Bounds that a correct sampler breaks with a stated, tiny probability."""

import math

import numpy as np

FALSE_ALARM = 1e-6


def binomial_bound(draws: int, probability, false_alarm: float = FALSE_ALARM):
    """Return how far a binomial count may lie from its mean, by Bernstein's inequality.

    P(|X - n p| > t) <= 2 exp(-t^2 / (2 n p (1 - p) + 2 t / 3)), solved for t.
    """
    level = math.log(2.0 / false_alarm)
    variance = draws * probability * (1.0 - probability)
    return level / 3.0 + np.sqrt(level**2 / 9.0 + 2.0 * level * variance)
