# SPDX-License-Identifier: Apache-2.0
"""How an untriggered rate unlearns the model when the executed path lags behind the plan.

Run: .venv/bin/python bench/untriggered.py [RATE [SEGMENTS [LAG_S ...]]]
"""

from dataclasses import replace
import sys

import numpy as np
from threadpoolctl import threadpool_limits

from srnn_bringup.config import Choices, load
from srnn_bringup.experiments.run import base_setting
from srnn_experiments.agent import NetworkAgent
from srnn_experiments.setting import Setting
from srnn_experiments.trial import make_run, make_world
from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.segment import ExecutedPath, Segment

SEED = 7000
QUARTERS = 4


class LateAgent(NetworkAgent):
    """Learns from executed paths as if they had been measured some time [s] too late."""

    lag = 0.0

    def learn(self, plan: Segment, executed: ExecutedPath, touched: bool) -> Dissonance | None:
        """Learn from the path shifted by the lag; before its start the arm stood there."""
        late = [np.interp(plan.times - self.lag, plan.times, x) for x in executed.positions.T]
        return super().learn(plan, replace(executed, positions=np.array(late).T), touched)


def line(setting: Setting, lag: float) -> str:
    """Return what a trial with this lag [s] showed, as a row of a table."""
    agent = LateAgent(setting.brain, SEED)
    agent.lag = lag
    run = make_run(setting, make_world(setting, SEED), agent)
    records = run.run(setting.segments)
    reached = np.array([record.after.reached - record.before.reached for record in records])
    quarters = ', '.join(str(part.sum()) for part in np.array_split(reached, QUARTERS))
    prior = agent.learner.neurons.prior_weights
    change = (agent.learner.synapses.dense() - prior)[prior > 0.0].mean()
    counters = run.sequencer.counters
    return (
        f'| {lag:g} | {quarters} | {change:.3f} | {counters.contacts} | '
        f'{counters.invalid_plans} |'
    )


def main() -> None:
    """Print a table with a row for every lag."""
    rate = float(sys.argv[1]) if len(sys.argv) > 1 else 0.01
    segments = int(sys.argv[2]) if len(sys.argv) > 2 else 300
    lags = [float(text) for text in sys.argv[3:]] or [0.0, 0.05, 0.15, 0.4]
    setting = base_setting(load(Choices(network='network_paper')), segments, 'point')
    setting = setting.with_signal('untriggered', rate)
    print('| lag [s] | way points reached in each quarter | mean change of excitatory synapses '
          '| contacts | invalid plans |')
    print('|---|---|---|---|---|')
    with threadpool_limits(1):
        for lag in lags:
            print(line(setting, lag), flush=True)


if __name__ == '__main__':
    main()
