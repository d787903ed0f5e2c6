# SPDX-License-Identifier: Apache-2.0
"""One run, two tables: every row is there, whatever is installed."""

import json
from pathlib import Path

import numpy as np
import pytest

from srnn_bench.bench import NAMES, Asked, run_bench
from srnn_bench.contender import Contender, started
from srnn_bench.errors import BenchError, PeerError
from srnn_bench.navigation_contenders import NAVIGATION_CONTENDERS
from srnn_bench.network_contenders import NETWORK_CONTENDERS, NetworkSetting
from srnn_bench.network_table import SLOW_ROUNDS, TURN, measure_network
from srnn_bench.peers import NOT_INSTALLED, Peer
from srnn_bench.remote import Remote
from srnn_config.scene import load_scene
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

SCENE = load_scene(Path(__file__).parents[3] / 'config' / 'scenes' / 'four_waypoints.yaml')
FAST = ('sampler', 'planner', 'numpy', 'known', 'a-star', 'mppi')
"""Rows that need no peer."""

TALKATIVE = """
import os
import time
print('imported')
class Runner:
    def __init__(self, offset):
        os.system('echo built')
        self.offset = offset
    def run(self, number):
        print('running')
        if number == 2:
            os._exit(5)
        time.sleep(0.01 * number)
        return self.offset / number
"""


def say(_):
    pass


def row_of(text, title):
    (line,) = (line for line in text.splitlines() if line.startswith(f'| {title} |'))
    return [cell.strip() for cell in line.strip('|').split('|')]


@pytest.fixture(scope='module')
def without_peers():
    """A run of all rows where no peer is installed."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Peer, 'versions', lambda self: {})
        return run_bench(Asked(SCENE, 2, 7, (), 'srnn bench --repeats 2'), say)


def test_a_peer_that_is_not_installed_has_a_row_that_says_how(without_peers):
    text = without_peers.markdown()
    for contender in (*NETWORK_CONTENDERS, *NAVIGATION_CONTENDERS):
        cells = row_of(text, contender.title)
        assert (cells[1] == NOT_INSTALLED) is (contender.peer is not None)
        assert (contender.name in FAST) is (contender.peer is None)
        assert cells[-1] == contender.remark.strip()
    assert f'- Brian2: {NOT_INSTALLED}' in text


def test_times_are_positive_and_ratios_are_those_of_the_medians(without_peers):
    document = json.loads(json.dumps(without_peers.document(), allow_nan=False))
    measured = {row['name']: row for row in document['network'] if not row['failure']}
    assert set(measured) == {'sampler', 'planner', 'numpy'}
    sampler, planner = (
        np.median(measured[name]['milliseconds']) for name in ('sampler', 'planner')
    )
    for row in measured.values():
        assert len(row['milliseconds']) == 2 * TURN
        assert min(row['milliseconds']) > 0.0
        assert len(row['call_ms']) == 2 * TURN
        assert (np.array(row['call_ms']) > row['milliseconds']).all()
        assert row['ratio'] == pytest.approx(np.median(row['milliseconds']) / sampler)
        assert row['ratio_planning'] == pytest.approx(np.median(row['milliseconds']) / planner)
        assert 100.0 < np.mean(row['spikes_per_movement']) < 150.0
    assert measured['numpy']['ratio'] > 1.0


def test_everybody_goes_every_leg_of_every_tour(without_peers):
    legs = {(leg, seed) for leg in range(4) for seed in (7, 8)}
    for row in without_peers.document()['navigation']:
        gone = {(leg['leg'], leg['seed']) for leg in row['legs']}
        assert gone == (set() if row['failure'] else legs)
        assert all(min(leg['plans_ms']) > 0.0 for leg in row['legs'])


def test_the_report_begins_with_command_and_machine(without_peers):
    lines = without_peers.markdown().splitlines()
    assert lines[2] == '`srnn bench --repeats 2`'
    for item in ('processor', 'cores', 'operating system', 'Python', 'versions: numpy'):
        assert any(line.startswith(f'- {item}') for line in lines)


def test_only_the_rows_asked_for_are_measured():
    results = run_bench(Asked(SCENE, 1, 0, ('a-star',), ''), say)
    assert [row['name'] for row in results.document()['navigation']] == ['a-star']
    assert results.document()['network'] == []
    assert 'The same network' not in results.markdown()


def test_slow_rows_have_a_single_run_in_some_of_the_rounds():
    slow = Contender(
        'slow', 'Slow', '', 'numpy_network', 'NumpyNetwork', lambda setting: (setting.task,),
        slow=True,
    )  # fmt: skip
    setting = NetworkSetting(ModelParameters(), PlanningParameters(), 0)
    (row,) = measure_network([slow], setting, SLOW_ROUNDS + 1, say)
    assert len(row.milliseconds) == len(row.calls) == len(row.spikes) == 2


def test_an_unknown_row_is_refused_with_all_there_are():
    words = r"unknown row 'brain2' \(did you mean 'brian2-cpp'\?\); rows: .*nest.*mppi"
    with pytest.raises(BenchError, match=words):
        Asked(SCENE, 1, 0, ('numpy', 'brain2'), '')
    assert len(set(NAMES)) == len(NAMES) == 16


@pytest.fixture
def talkative(tmp_path):
    (tmp_path / 'talkative.py').write_text(TALKATIVE)
    remote = Remote('talkative', 'Runner', (6.0,), tmp_path)
    yield remote
    remote.close()


def test_what_a_peer_prints_or_raises_does_not_get_between_replies(talkative):
    assert talkative.run(3) == 2.0
    with pytest.raises(PeerError, match='ZeroDivisionError: float division by zero'):
        talkative.run(0)
    assert talkative.run(1) == 6.0


def test_what_a_call_took_is_measured_in_its_process(talkative):
    for number in (1, 3):
        talkative.run(number)
        assert talkative.seconds >= 0.01 * number


def test_a_peer_whose_process_ends_is_an_error(talkative):
    with pytest.raises(PeerError, match='its process has ended with code 5'):
        talkative.run(2)
    with pytest.raises(PeerError, match='code 5'):
        talkative.run(1)


def test_a_contender_that_cannot_be_built_has_the_reason_as_its_row():
    broken = Contender('broken', 'Broken', '', 'nowhere', 'Nobody', lambda task: ())
    with started([broken], None, ()) as (entry,):
        assert entry.run() is None
    assert entry.failure == "failed: ModuleNotFoundError: No module named 'srnn_bench.nowhere'"


def test_a_contender_without_its_tools_says_which():
    needy = Contender(
        'needy', 'Needy', '', 'numpy_network', 'NumpyNetwork', lambda task: (),
        tools=('no-such-program',),
    )  # fmt: skip
    with started([needy], None, ()) as (entry,):
        assert entry.failure == 'not possible here: there is no no-such-program'
