# SPDX-License-Identifier: Apache-2.0
"""What `srnn belief` says of a bag and of weight files, and what it writes."""

import json
from pathlib import Path

import numpy as np
import pytest
from rclpy.serialization import serialize_message
import yaml

from srnn_bag import BagWriter
from srnn_bag.attached import PARAMETERS
from srnn_bringup import cli
from srnn_bringup.config import Choices, load
from srnn_config import to_mapping
from srnn_msgs_py.ros import weights
from srnn_msgs_py.topics import topic
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate
from srnn_planner.core import weights_file
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses

MODEL = load(Choices()).network.model
NEURONS = StateNeurons(MODEL.network)
PRIOR = NEURONS.prior_weights


def matrix(*neurons: int) -> np.ndarray:
    weights = PRIOR.copy()
    weights[:, list(neurons)] = -1.0
    return weights


def learned(*neurons: int) -> LearnedWeights:
    return Synapses.of(NEURONS.prior, matrix(*neurons)).learned


def dense(update: WeightsUpdate) -> np.ndarray:
    return NEURONS.synapses(update.learned).dense()


VERSIONS = (learned(), learned(30), learned(30, 31), learned(30, 31, 90))


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """Return a bag with three updates."""
    row = topic('weights')
    told = {'/**': {'ros__parameters': {'seed': 1, 'model': to_mapping(MODEL)}}}
    with BagWriter(tmp_path / 'bag') as writer:
        writer.attach(PARAMETERS.format('adapter'), 'x', yaml.safe_dump(told).encode(), 0)
        writer.add_topic('/arm/weights', row.type_name, row.qos)
        for version, weights_then in enumerate(VERSIONS):
            msg = weights.to_msg(WeightsUpdate(version, 7 * version, weights_then))
            sent_ns = 10**18 + 2 * 10**9 * version
            data = bytes(serialize_message(msg))
            writer.write('/arm/weights', data, sent_ns, sent_ns, version + 1)
    return tmp_path / 'bag'


def run(line: str) -> int:
    return cli.main(['belief', *line.split()])


def test_every_version_is_listed_with_what_it_changed_where(bag, capsys):
    assert run(f'list {bag}') == 0
    _, *rows = (line.split() for line in capsys.readouterr().out.splitlines())
    assert [row[:3] for row in rows[:2]] == [['0', '0.0', 's'], ['1', '2.0', 's']]
    x, y = MODEL.workspace.to_metres(StateNeurons(MODEL.network).positions[90])
    assert rows[3][-2:] == [f'{x:.3f},', f'{y:.3f}']
    assert rows[0][3] == '0'
    assert int(rows[1][3]) == (matrix(30) != PRIOR).sum()


def test_one_update_is_undone_and_the_later_ones_stay(bag, tmp_path):
    assert run(f'revert {bag}@2 {tmp_path}/without.npz') == 0
    kept = weights_file.load(tmp_path / 'without.npz')
    np.testing.assert_allclose(dense(kept), matrix(30, 90), atol=1e-6)
    assert kept.version == 4


def test_two_runs_are_put_together(bag, tmp_path):
    one, other = tmp_path / 'one.npz', tmp_path / 'other.npz'
    weights_file.save(one, WeightsUpdate(3, 0, learned(5)))
    weights_file.save(other, WeightsUpdate(8, 0, learned(100)))
    assert run(f'merge {one} {other} {tmp_path}/both.npz') == 0
    both = weights_file.load(tmp_path / 'both.npz')
    assert both.learned.same_as(learned(5, 100))
    assert both.version == 9
    assert run(f'merge {bag}@1 {other} {tmp_path}/mixed.npz') == 0
    mixed = weights_file.load(tmp_path / 'mixed.npz')
    assert mixed.learned.same_as(learned(30, 100))


def test_versions_are_compared_and_drawn(bag, tmp_path, capsys):
    assert run(f'diff {bag}@1 {bag}@2 --picture {tmp_path}/diff.png') == 0
    assert str((matrix(30, 31) != matrix(30)).sum()) in capsys.readouterr().out
    assert run(f'show {bag} {tmp_path}/show.png') == 0
    for name in ('diff.png', 'show.png'):
        assert (tmp_path / name).read_bytes().startswith(b'\x89PNG')


@pytest.mark.parametrize(
    ('line', 'words'),
    [
        ('list {bag}@7', 'has no version 7; versions: 0, 1, 2, 3'),
        ('list {bag}@x', 'behind @ must be the number of a version'),
        ('revert {bag} w.npz', 'name the update to undo as BAG@N'),
        ('show {bag} p.txt', '.png, .pdf, .svg'),
        ('list nowhere.npz', 'there is no such bag or weight file'),
        ('mege a b c', "'list', 'show', 'diff', 'revert', 'merge'"),
    ],
)
def test_mistakes_get_one_line_that_helps(bag, line, words, capsys, monkeypatch):
    monkeypatch.chdir(bag.parent)
    try:
        code = run(line.format(bag=bag))
    except SystemExit as end:
        code = end.code
    error = capsys.readouterr().err
    assert code == 2
    assert error.count('\n') == 1
    assert words in error


def test_versions_and_differences_are_told_to_machines(bag, tmp_path, capsys):
    assert run(f'list {bag} --json -') == 0
    versions = json.loads(capsys.readouterr().out)['versions']
    assert [(v['version'], v['after_s']) for v in versions] == [
        (0, 0.0), (1, 2.0), (2, 4.0), (3, 6.0),
    ]  # fmt: skip
    assert versions[0]['where_m'] is None
    assert run(f'diff {bag}@0 {bag}@1 --json {tmp_path}/diff.json') == 0
    found = json.loads((tmp_path / 'diff.json').read_text())
    assert found['synapses'] == versions[1]['synapses'] == (matrix(30) != PRIOR).sum()
    np.testing.assert_allclose(found['where_m'], versions[1]['where_m'])
