# SPDX-License-Identifier: Apache-2.0
"""The compiled sampler in plain Python: every potential anew in every step, same words."""

import math

import numpy as np

from srnn_planner.core.decoding import spike_activity

MASK = 2**64 - 1


class Words:
    """SplitMix64 in plain whole numbers."""

    def __init__(self, state):
        self._state = int(state)

    def word(self):
        z = self._state
        self._state = (self._state + 0x9E3779B97F4A7C15) & MASK
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        return z ^ (z >> 31)

    def uniform(self):
        return (self.word() >> 11) * 2.0**-53

    def gap(self, scale):
        return int(math.log1p(-self.uniform()) * scale)

    def bernoulli(self, probability, count):
        """Return one boolean for each of up to 64 numbers."""
        if probability >= 1.0:
            return np.ones(count, dtype=bool)
        drawn, undecided = 0, 2**count - 1
        while probability > 0.0 and undecided:
            probability *= 2.0
            random = self.word()
            if probability >= 1.0:
                probability -= 1.0
                drawn |= undecided & ~random
                undecided &= random
            else:
                undecided &= ~random
        return np.array([bool(drawn >> j & 1) for j in range(count)])


def sample(sampler, context, history, seeds, positions, bias):
    """Return what `Sampler.sample` returns."""
    synapses, law = sampler.synapses, sampler.law
    weights = synapses.dense()
    theta = np.rint(context.weights * synapses.scale).astype(np.int64)
    whole_bias = np.rint(bias * synapses.scale).astype(np.int64)
    steps, tau = len(context.spike_probability), law.tau
    samples, neurons = history.shape
    spikes = np.zeros((samples, steps, neurons), dtype=bool)
    seldom, passing = math.ceil(law.seldom * synapses.scale), 1.0 / math.log1p(-law.rare)
    slope = law.slope / synapses.scale
    for s in range(samples):
        words = Words(seeds[s])
        last, fired = history[s].astype(np.int64), []
        to_pass = words.gap(passing)
        for t in range(steps):
            active = np.any(fired[-tau:], axis=0) if fired else np.zeros(len(theta), dtype=bool)
            groups = [
                words.bernoulli(context.spike_probability[t], min(64, len(theta) - first))
                for first in range(0, len(theta), 64)
            ]
            fired.append(np.concatenate(groups))
            potential = t - last <= tau
            u = whole_bias + weights[potential].sum(axis=0) + theta[active].sum(axis=0)
            silent = potential & law.absolute
            likely = (u > seldom) & ~silent

            def probability(k, u=u, t=t, last=last):
                exponent = max(u[k] * slope - law.threshold, -700.0)
                value = math.exp(min(exponent, law.saturated))
                since = t - last[k]
                return value * since / tau if since <= tau else value

            above = likely.copy()
            for first in range(0, neurons, 64):
                for _ in range(law.halvings):
                    bits = words.word() >> np.arange(64, dtype=object) & 1
                    above[first : first + 64] &= bits.astype(bool)[: neurons - first]
            share = 0.5**law.halvings
            now = [k for k in np.flatnonzero(above) if share * words.uniform() < probability(k)]
            while to_pass < neurons:
                k, draw = to_pass, law.rare * words.uniform()
                if not likely[k] and not silent[k] and draw < probability(k):
                    now.append(k)
                to_pass += 1 + words.gap(passing)
            to_pass -= neurons
            spikes[s, t, now] = True
            last[now] = t
    activity = spike_activity(spikes, history, positions, tau)
    return spikes.sum(axis=0), activity
