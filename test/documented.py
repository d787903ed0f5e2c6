# SPDX-License-Identifier: Apache-2.0
"""The pages of the documentation, and what of their fenced blocks can be run.

A block whose opening line has a name behind its language is a file that the reader writes; `sh`
is typed in; `python` that imports something is a script, and else a fragment. The blocks of a page
run one after the other, in one folder.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
import re

ROOT = Path(__file__).parents[1]
PAGES = (
    ROOT / 'README.md', ROOT / 'CONTRIBUTING.md', ROOT / 'examples' / 'README.md',
    *(page for page in sorted((ROOT / 'docs').rglob('*.md'))),
)  # fmt: skip

_FENCE = re.compile(r'^```(\w*) ?(\S*)\n(.*?)^```$', re.MULTILINE | re.DOTALL)

UNTIL_CTRL_C = re.compile(r'srnn (up|record)\b')
"""Commands that go on until the reader ends them."""

SLOW = re.compile(r'srnn (demo|up|record|replay|experiment|bench)\b|examples/')

SHORTER = (
    (re.compile(r'srnn demo\b'), '--segments 4'),
    (re.compile(r'srnn experiment (run|transfer)\b'), '--trials 2 --segments 6'),
    (re.compile(r'srnn experiment table1\b'), '--trials 2 --segments 6 --world point'),
    (re.compile(r'srnn experiment figures\b'), '--trials 2 --segments 6 --long 6 --world point'),
    (re.compile(r'srnn experiment random\b'), '--scenes 2 --segments 6'),
    (re.compile(r'examples/own_(world|signal)\.py'), '20'),
)
"""What makes a command take seconds; of an option that is given twice the last counts."""

NOT_RUN = {
    r'make ': 'sets up, tests or cleans the environment that this test runs in',
    r'.*\bsudo\b': 'changes the machine',
    r'(colcon|source|ros2|rosdep)\b': 'needs an installation of ROS 2',
    r'.* --peer\b': 'needs other hosts: test/faults/test_two_hosts.py runs it on two of them',
    r'.* --secure\b': 'needs DDS security: test/test_secured_graph.py',
}
"""Beginnings of commands that no test of a page runs, and why."""

FOLLOWS = 'follows, in its block, one that is not run'


@dataclass(frozen=True)
class Block:
    """A fenced block: its language, the name of the file that it is, if any, and its text."""

    language: str
    name: str
    text: str

    @property
    def commands(self) -> list[str]:
        """What is typed in, without comments."""
        if self.language != 'sh' or self.name:
            return []
        joined = self.text.replace('\\\n', ' ')
        lines = (re.sub(r'(^|\s)#.*', '', line).strip() for line in joined.splitlines())
        return [line for line in lines if line]

    @property
    def script(self) -> bool:
        """Whether the block is a whole script."""
        return self.language == 'python' and not self.name and 'import ' in self.text

    @property
    def reasons(self) -> list[str]:
        """Why each command is not run, nothing for those that are."""
        reasons: list[str] = []
        for command in self.commands:
            why = reason_not_to(command)
            reasons.append(why or (FOLLOWS if any(reasons) else ''))
        return reasons

    @property
    def runnable(self) -> list[str]:
        """The commands that are run."""
        pairs = zip(self.commands, self.reasons, strict=True)
        return [command for command, why in pairs if not why]


def blocks(page: Path) -> Iterator[Block]:
    for match in _FENCE.finditer(page.read_text(encoding='utf-8')):
        yield Block(*match.groups())


def reason_not_to(command: str) -> str:
    """Return why a command is not run, nothing if it is."""
    return next((why for begin, why in NOT_RUN.items() if re.match(begin, command)), '')


def shortened(command: str, port: int) -> str:
    """Return a command with what makes it short, its live view at a port that is free."""
    command = re.sub(r'--view\b( \d+)?', f'--view {port}', command)
    return ' '.join([command, *(words for name, words in SHORTER if name.search(command))])


def inline_code() -> Iterator[tuple[Path, str]]:
    """Yield what stands between single backticks outside of blocks, with its page."""
    for page in PAGES:
        text = _FENCE.sub('', page.read_text(encoding='utf-8'))
        for match in re.finditer(r'`([^`]+)`', text):
            yield page, ' '.join(match[1].split())
