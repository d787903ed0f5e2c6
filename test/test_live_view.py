# SPDX-License-Identifier: Apache-2.0
"""`--view` in a real browser, beside a real graph."""

from pathlib import Path
import re
import socket

from browser import BROWSER, Browser
import pytest
from srnn_process import RUN_S, SCENE, STOP_S, Srnn, nothing_left

LOADED_S = 120.0
"""A scene is drawn by the processor here, after everything else."""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / 'wall.yaml').write_text(SCENE)
    return tmp_path


@pytest.fixture
def port():
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


def text_of(name: str) -> str:
    return f"document.getElementById('srnn-{name}')?.innerText"


@pytest.mark.slow
@pytest.mark.skipif(BROWSER is None, reason='this machine has no Chromium')
def test_the_page_shows_a_run_while_it_learns(folder, port, request):
    pictures = Path(request.config.getoption('--screenshots') or folder)
    srnn = Srnn(
        folder, 'demo', '--scene', 'wall.yaml', '--segments', '500', '--seed', '2',
        '--view', str(port),
    )  # fmt: skip
    try:
        srnn.wait_for(f'live view: http://127.0.0.1:{port}')
        srnn.wait_for('segment  way point')
        with Browser(folder, 1400, 900) as browser:
            browser.open(f'http://127.0.0.1:{port}')
            browser.until("document.querySelector('canvas') !== null", LOADED_S)
            # It warns that there is no graphics card.
            browser.click("document.querySelector('.mantine-Notification-closeButton')")
            first = int(browser.until(text_of('segments'), LOADED_S))
            before = browser.screenshot(folder / 'before.png')
            browser.until(f'Number({text_of("segments")}) >= {first + 4}', RUN_S)
            browser.until(f'Number({text_of("updates")}) >= 1', RUN_S)
            after = browser.screenshot(pictures / 'live_view.png')
            for tab in ('Times', 'Nodes', 'Events'):
                browser.click(TAB.format(tab))
                browser.until(f"document.body.innerText.includes('{WORDS[tab]}')", LOADED_S)
                browser.screenshot(pictures / f'live_view_{tab.lower()}.png')
            assert browser.complaints == []
        assert before != after
        assert 'view ended' not in srnn.text
    finally:
        srnn.close()
    assert nothing_left(srnn, folder)


TAB = "[...document.querySelectorAll('[role=tab]')].find(tab => tab.innerText === '{}')"
WORDS = {'Times': 'planning', 'Nodes': 'tracker', 'Events': 'touch'}
"""What is to be read on each page."""


def test_a_port_that_is_taken_is_named_before_anything_starts(folder):
    with socket.socket() as other:
        other.bind(('127.0.0.1', 0))
        other.listen()
        port = other.getsockname()[1]
        srnn = Srnn(folder, 'demo', '--view', str(port))
        try:
            assert srnn.wait(STOP_S) == 1
        finally:
            srnn.close()
    assert re.search(rf'srnn demo: view: port = {port}: Address already in use', srnn.text)
    assert 'starting' not in srnn.text
    assert nothing_left(srnn, folder)


def test_nobody_else_can_look(folder, port):
    """The page is served to this machine alone, and the view says nothing in the graph."""
    srnn = Srnn(folder, 'demo', '--segments', '500', '--view', str(port))
    try:
        srnn.wait_for('live view')
        listening = Path('/proc/net/tcp').read_text() + Path('/proc/net/tcp6').read_text()
        places = re.findall(rf'([0-9A-F]+):{port:04X} [0-9A-F]+:0000 0A', listening)
        assert places == ['0100007F']
    finally:
        srnn.close()
