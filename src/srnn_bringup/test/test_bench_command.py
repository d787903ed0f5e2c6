# SPDX-License-Identifier: Apache-2.0
import json

from srnn_bringup import cli


def test_tables_go_to_the_terminal_and_to_files(tmp_path, capsys):
    out, figures = tmp_path / 'bench.md', tmp_path / 'bench.json'
    line = f'bench --only a-star,mppi --repeats 2 --seed 3 --out {out} --json {figures}'
    assert cli.main(line.split()) == 0
    shown = capsys.readouterr()
    assert shown.out.rstrip() == out.read_text().rstrip()
    command = 'srnn bench --scene four_waypoints --repeats 2 --seed 3 --only a-star,mppi'
    assert f'`{command}`' in shown.out
    assert 'tour 2 of 2' in shown.err
    document = json.loads(figures.read_text())
    assert [row['name'] for row in document['navigation']] == ['a-star', 'mppi']
    assert {leg['seed'] for leg in document['navigation'][1]['legs']} == {3, 4}
