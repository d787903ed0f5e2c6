# SPDX-License-Identifier: Apache-2.0
"""Pages need nothing else, and nothing that comes from a run can act in them."""

from html.parser import HTMLParser
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st
import pytest

from srnn_bringup import cli
from srnn_bringup.page import html
from srnn_bringup.page.markdown import from_markdown, inline

VOID = {'meta', 'img', 'input', 'br'}
PIXEL = bytes.fromhex(
    '89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c4890000000d49444154789c6360606060'
    '0000000500017a5eab3f0000000049454e44ae426082'
)


class Strict(HTMLParser):
    """Reads a page and demands that what is opened is closed, in order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open, self.seen, self.words = [], [], ''
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag, attributes):
        self.seen.append((tag, dict(attributes)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words += data


texts = st.text(st.characters(codec='utf-8', exclude_characters='\r\0'), max_size=40)


@given(texts, texts)
def test_whatever_a_run_says_is_text(one, other):
    page = html.page(one, [
        html.section(other, html.paragraph(one)), html.cards([(one, other)]),
        html.table((one, 'b'), [(other, one)], numbers=1, classes=[other]),
    ])  # fmt: skip
    read = Strict(page)
    assert {tag for tag, _ in read.seen} <= {
        'html', 'head', 'meta', 'title', 'style', 'body', 'h1', 'h2', 'p', 'div', 'b', 'span',
        'table', 'thead', 'tbody', 'tr', 'th', 'td',
    }  # fmt: skip
    assert one in read.words
    assert other in read.words


@given(texts)
def test_no_text_ends_a_script(text):
    page = html.script('animation.js', RUN={'name': f'</script><b>{text}'})
    read = Strict(page)
    assert [tag for tag, _ in read.seen] == ['script']


@given(texts)
def test_markdown_of_anything_is_well_formed(text):
    Strict('\n'.join(from_markdown(text, Path('/nowhere'))))
    Strict(f'<p>{inline(text)}</p>')


def test_an_experiment_becomes_one_page(tmp_path, capsys, monkeypatch):
    (tmp_path / 'fig.png').write_bytes(PIXEL)
    (tmp_path / 'figures.md').write_text(
        '# Ten trials\n\n## It learns\n\n![fig](fig.png)\n\n'
        'Words, `code`. Numbers: [fig.json](fig.json).\n\n* **one** & two\n* three\n\n'
        '| a | b |\n|---|---|\n| 1 | <2> |\n'
    )
    monkeypatch.chdir(tmp_path)
    assert cli.main(['report', str(tmp_path), '--out', 'page.html']) == 0
    assert 'report: page.html' in capsys.readouterr().out
    read = Strict((tmp_path / 'page.html').read_text())
    (image,) = [attributes for tag, attributes in read.seen if tag == 'img']
    assert image['src'].startswith('data:image/png;base64,')
    tags = [tag for tag, _ in read.seen]
    assert (tags.count('li'), tags.count('td'), tags.count('code')) == (2, 2, 1)
    for words in ('It learns', 'one', ' & two', '<2>', 'Numbers: fig.json.'):
        assert words in read.words


@pytest.mark.parametrize('name', ['nowhere', '.'])
def test_what_is_neither_is_named(name, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert cli.main(['report', name]) == 2
    assert 'is no recording, and no directory with results' in capsys.readouterr().err
