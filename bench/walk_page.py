# SPDX-License-Identifier: Apache-2.0
"""The page of all walks: a table of times, and a section for each; pure.

A walk that was not made now keeps its row and its section.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import re

from walk import Done, Walk
from walk_transcript import RULE, Cleaner, duration, transcript

COMMAND = 'bench/walks.py'
HEAD = f"""# Three walks, with times

Somebody who knows nothing of this project, three times: what is typed in, what is seen, how long
it takes. Made by `{COMMAND}`: it does every command below, in an empty home, with an environment
and a `ROS_DOMAIN_ID` of its own. It fails if one of them does not print what it must, or ends
with another exit code, or if a walk takes more than ten minutes.

| walk | begins with | commands | longest | in all |
|---|---|---|---|---|
"""


@dataclass(frozen=True)
class Walked:
    """A walk that was made, in this time [s], and on what."""

    walk: Walk
    done: Sequence[Done]
    seconds: float
    facts: str


def row(one: Walked) -> str:
    """Return the row of a walk in the table of times."""
    longest = max(one.done, key=lambda done: done.seconds)
    words = longest.step.command.partition('\n')[0]
    count = sum(1 + len(done.step.meanwhile) for done in one.done)
    return (
        f'| {one.walk.title} | {one.walk.begins} | {count} | `{words}`: '
        f'{duration(longest.seconds)} | **{duration(one.seconds)}** |'
    )


def section(one: Walked, cleaner: Cleaner) -> str:
    """Return the section of a walk."""
    lines = [f'## {heading(one.walk)}', '', one.facts, '', *transcript(one.done, cleaner)]
    return '\n'.join(lines).rstrip('\n') + '\n'


def heading(walk: Walk) -> str:
    """Return what stands above the section of a walk."""
    return walk.title[0].upper() + walk.title[1:]


def page(walks: Sequence[Walk], made: Mapping[str, Walked], cleaner: Cleaner, old: str) -> str:
    """Return the page.

    Args:
        walks: all walks, in their order.
        made: those that were made now, by name.
        cleaner: takes out of their outputs what tells of the machine.
        old: the page as it was, from which the others are taken if they are there.

    """
    rows: list[str] = []
    sections: list[str] = []
    for walk in walks:
        if walk.name in made:
            rows.append(row(made[walk.name]))
            sections.append(section(made[walk.name], cleaner))
        else:
            rows += re.findall(rf'^\| {re.escape(walk.title)} \|.*$', old, re.MULTILINE)
            sections += re.findall(
                rf'^## {re.escape(heading(walk))}\n(?:(?!## ).*\n)*', old, re.MULTILINE
            )
    table = ''.join(f'{line}\n' for line in rows)
    return '\n'.join([f'{HEAD}{table}', f'{RULE}\n', *(f'{s.rstrip()}\n' for s in sections)])
