# SPDX-License-Identifier: Apache-2.0
"""What a command says: words, a document alone on standard output, or nothing."""

import json

import pytest

from srnn_bringup import cli
from srnn_bringup.run_outputs import write_report
from srnn_bringup.speech import STDOUT, progress, remark, speaking, write_document
from srnn_bringup.trial import Run

RUN = 'experiment run --world point --segments 3 --workers 1'
BENCH = 'bench --only a-star --repeats 1'


@pytest.mark.parametrize(
    ('line', 'keys', 'words'),
    [
        (RUN, {'scene', 'summary', 'trials'}, 'trials of 3 segments'),
        (BENCH, {'command', 'navigation'}, 'tour 1 of 1'),
    ],
)
def test_a_document_is_alone_on_standard_output(line, keys, words, capsys):
    assert cli.main([*line.split(), '--json', '-']) == 0
    shown = capsys.readouterr()
    assert keys <= json.loads(shown.out).keys()
    assert words in shown.err
    assert cli.main([*line.split(), '--json', '-', '--quiet']) == 0
    shown = capsys.readouterr()
    assert keys <= json.loads(shown.out).keys()
    assert shown.err == ''


@pytest.mark.parametrize('line', [RUN, BENCH, 'key create {}/graph.key'])
def test_whoever_wants_quiet_hears_nothing_and_gets_the_files(line, tmp_path, capfd):
    written = f' --json {tmp_path}/figures.json' if line in (RUN, BENCH) else ''
    assert cli.main([*(line + written).format(tmp_path).split(), '-q']) == 0
    assert capfd.readouterr() == ('', '')
    assert len(list(tmp_path.iterdir())) == 1


def test_errors_are_said_even_to_those_who_want_quiet(tmp_path, capsys):
    assert cli.main(['demo', '--scene', 'nowhere', '--quiet', '--json', '-']) == 2
    shown = capsys.readouterr()
    assert (shown.out, "no scene 'nowhere'" in shown.err) == ('', True)


def test_the_figures_of_a_demo_can_be_all_it_says(configuration, recorder, capsys, monkeypatch):
    def run_demo(configuration, segments, outputs, *_):
        print('a segment')
        write_report(configuration, recorder, Run((), 0.0, 0, segments), outputs, print)
        return 0

    monkeypatch.setattr('srnn_bringup.demo.run_demo', run_demo)
    assert cli.main(['demo', '--json', '-']) == 0
    shown = capsys.readouterr()
    assert json.loads(shown.out)['segments'] == 150
    assert 'a segment' in shown.err


def test_without_a_wish_words_are_on_standard_output(capsys, tmp_path):
    with speaking(False, tmp_path / 'a.json'):
        print('word')
        remark('remark')
        write_document(tmp_path / 'a.json', {'a': 1})
        assert not progress(1, 'title', 'unit').disable
    shown = capsys.readouterr()
    assert (shown.out, 'remark' in shown.err) == ('word\n', True)
    assert json.loads((tmp_path / 'a.json').read_text()) == {'a': 1}


def test_the_wish_ends_with_the_command(capsys):
    with speaking(True, STDOUT):
        print('word')
        write_document(STDOUT, {})
    print('next')
    assert capsys.readouterr().out == '{}\nnext\n'
