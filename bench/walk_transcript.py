# SPDX-License-Identifier: Apache-2.0
"""Walks as a page: what was typed in, what it printed, shortened, and how long it took; pure."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
import re

from walk import Done

HEAD = 6
TAIL = 6
"""Lines at the beginning and at the end of an output that are shown."""

WIDTH = 150
"""Characters of a line that are shown."""

RULE = (
    f'Of an output the first {HEAD} and last {TAIL} lines are shown, and the first one that has '
    f'what the command must print; of a line, {WIDTH} characters; of progress, its last state.\n'
    '`~` is the home of the walk. Other folders of the machine (`…/`), its name, users and '
    'addresses are left out.'
)

PROMPT = '$ '
MORE = '> '

_ESCAPES = re.compile(r'\x1b(\[[0-9;?]*[ -/]*[@-~]|\][^\x07]*\x07)')
_URL = re.compile(r'\b[a-z+]+://(?!127\.0\.0\.1|localhost)[^\s\'")]+')
_PATH = re.compile(r'(?<![\w~.…/:-])/([\w.@+-]+)((?:/[\w.@+-]+)+)')


@dataclass(frozen=True)
class Cleaner:
    """Takes out of a text what tells of the machine.

    Attributes:
        names: what stands for what; longer ones first.
        roots: folders of the root of the file system: what begins with one is a path.

    """

    names: Mapping[str, str]
    roots: frozenset[str]

    def clean(self, text: str) -> str:
        """Return a text without escapes, progress, paths, names and addresses."""
        lines = (line.rstrip('\r').rpartition('\r')[2] for line in text.split('\n'))
        text = _ESCAPES.sub('', '\n'.join(line.rstrip() for line in lines))
        for name in sorted(self.names, key=len, reverse=True):
            end = r'(?!\w)' if re.search(r'\w$', name) else ''
            begin = r'(?<!\w)' if re.match(r'\w', name) else ''
            replacement = self.names[name]
            text = re.sub(begin + re.escape(name) + end, lambda _, r=replacement: r, text)
        return _PATH.sub(self._path, _URL.sub('URL', text))

    def _path(self, match: re.Match[str]) -> str:
        if match[1] not in self.roots:
            return match[0]
        return f'…{match[2][match[2].rindex("/") :]}'


def shortened(text: str, promise: str) -> list[str]:
    """Return the lines of an output that are shown, with how many are left out in between."""
    lines = text.strip('\n').split('\n') if text.strip() else []
    shown = {*range(min(HEAD, len(lines))), *range(max(len(lines) - TAIL, 0), len(lines))}
    match = re.search(promise, text.strip('\n'), re.MULTILINE) if promise else None
    if match:
        shown.add(text.strip('\n').count('\n', 0, match.start()))
    result: list[str] = []
    last = -1
    for index in sorted(shown):
        left_out = index - last - 1
        # One line that is left out takes as much room as to say so.
        if left_out:
            result.append(lines[index - 1] if left_out == 1 else f'... {left_out} lines')
        result.append(lines[index])
        last = index
    return [line if len(line) <= WIDTH else f'{line[: WIDTH - 1]}…' for line in result]


def duration(seconds: float) -> str:
    """Return a time as people say it."""
    if seconds < 60.0:
        return f'{seconds:.1f} s'
    return f'{round(seconds) // 60} min {round(seconds) % 60} s'


def typed(command: str) -> str:
    """Return a command as it stands in a terminal."""
    return PROMPT + command.rstrip('\n').replace('\n', f'\n{MORE}')


def commands(page: str) -> list[str]:
    """Return the commands that a page shows, in its order."""
    found: list[str] = []
    for line in page.split('\n'):
        if line.startswith(PROMPT):
            found.append(line.removeprefix(PROMPT))
        elif line.startswith(MORE.rstrip()) and found:
            found[-1] += '\n' + line.removeprefix(MORE)
    return found


def transcript(done: Sequence[Done], cleaner: Cleaner, other: bool = False) -> Iterator[str]:
    """Yield the lines of a walk's transcript."""
    for one in done:
        where = 'In another terminal: ' if other else ''
        yield f'{where}{one.step.why}'
        yield ''
        yield '```'
        yield typed(one.step.command)
        yield from shortened(cleaner.clean(one.output), one.step.promise)
        yield '```'
        yield ''
        ended = 'Ended by Ctrl-C, exit' if one.step.ctrl_c else 'Exit'
        yield f'{ended} code {one.code}, {duration(one.seconds)}.'
        yield ''
        yield from transcript(one.meanwhile, cleaner, other=True)


