# SPDX-License-Identifier: Apache-2.0
"""A headless browser, driven over its debugging port, in real time."""

import base64
import json
import os
from pathlib import Path
import shutil
import subprocess
import time
from types import TracebackType
from typing import Any, Self
from urllib.request import urlopen

from websockets.sync.client import connect

START_S = 60.0
ANSWER_S = 60.0
BROWSERS = ('chromium', 'chromium-browser', 'google-chrome')

BROWSER = next((path for name in BROWSERS if (path := shutil.which(name))), None)
"""Program of the browser; None if this machine has none."""

_ARGUMENTS = (
    '--headless', '--no-sandbox', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--disable-quic', '--mute-audio',
    # Without a graphics card the scene is drawn by the processor.
    '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--remote-debugging-port=0', 'about:blank',
)  # fmt: skip


class Browser:
    """One page. It draws with what the graph leaves of the processors.

    Attributes:
        complaints: errors of the page, as its console shows them.

    """

    def __init__(self, folder: Path, width: int, height: int) -> None:
        self.complaints: list[str] = []
        self._profile = folder / 'browser'
        self._size = width, height
        self._number = 0

    def __enter__(self) -> Self:
        assert BROWSER is not None
        with (self._profile.parent / 'browser.log').open('wb') as log:
            self._process = subprocess.Popen(
                [
                    BROWSER, f'--user-data-dir={self._profile}',
                    f'--window-size={self._size[0]},{self._size[1]}', *_ARGUMENTS,
                ],
                stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                preexec_fn=lambda: os.nice(10),
            )  # fmt: skip
        self._socket = connect(self._page(), max_size=None)
        for domain in ('Runtime', 'Log', 'Page'):
            self._call(f'{domain}.enable')
        width, height = self._size
        self._call(
            'Emulation.setDeviceMetricsOverride', width=width, height=height,
            deviceScaleFactor=1, mobile=width < 600,
        )  # fmt: skip
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._socket.close()
        self._process.terminate()
        try:
            self._process.wait(10.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait(10.0)

    @property
    def pid(self) -> int:
        """Id of its first process."""
        return self._process.pid

    def open(self, address: str) -> None:
        """Go to a page."""
        self._call('Page.navigate', url=address)

    def evaluate(self, expression: str) -> Any:
        """Return the value of a JavaScript expression in the page."""
        result = self._call('Runtime.evaluate', expression=expression, returnByValue=True)
        assert 'exceptionDetails' not in result, result
        return result['result'].get('value')

    def until(self, expression: str, seconds: float) -> Any:
        """Wait until an expression is true; return its value."""
        end = time.monotonic() + seconds
        while not (value := self.evaluate(expression)):
            assert time.monotonic() < end, f'{expression}: {value!r}; {self.complaints}'
            time.sleep(0.2)
        return value

    def click(self, element: str) -> None:
        """Click in the middle of an element, given as a JavaScript expression."""
        x, y = self.evaluate(
            f'(r => [r.x + r.width / 2, r.y + r.height / 2])(({element}).getBoundingClientRect())'
        )
        for kind in ('mousePressed', 'mouseReleased'):
            self._call(
                'Input.dispatchMouseEvent', type=kind, x=x, y=y, button='left', clickCount=1
            )

    def screenshot(self, file: Path) -> bytes:
        """Write a picture of the page, and return it."""
        picture = base64.b64decode(self._call('Page.captureScreenshot', format='png')['data'])
        file.write_bytes(picture)
        return picture

    def _page(self) -> str:
        """Return the address at which the page can be driven."""
        port = self._profile / 'DevToolsActivePort'
        end = time.monotonic() + START_S
        while not (port.is_file() and port.read_text().strip()):
            assert self._process.poll() is None, 'the browser has ended'
            assert time.monotonic() < end, 'the browser does not start'
            time.sleep(0.1)
        number = port.read_text().split()[0]
        with urlopen(f'http://127.0.0.1:{number}/json') as answer:
            pages = json.load(answer)
        address: str = next(p for p in pages if p['type'] == 'page')['webSocketDebuggerUrl']
        return address

    def _call(self, method: str, **parameters: Any) -> Any:
        self._number += 1
        self._socket.send(
            json.dumps({'id': self._number, 'method': method, 'params': parameters})
        )
        while True:
            message = json.loads(self._socket.recv(ANSWER_S))
            if message.get('id') == self._number:
                assert 'error' not in message, message
                return message['result']
            self._hear(message)

    def _hear(self, event: dict[str, Any]) -> None:
        match event.get('method'), event.get('params', {}):
            case 'Runtime.exceptionThrown', {'exceptionDetails': details}:
                self.complaints.append(json.dumps(details)[:500])
            case 'Runtime.consoleAPICalled', {'type': 'error' | 'assert', 'args': arguments}:
                self.complaints.append(json.dumps(arguments)[:500])
            case 'Log.entryAdded', {'entry': {'level': 'error'} as entry}:
                self.complaints.append(json.dumps(entry)[:500])
