# SPDX-License-Identifier: Apache-2.0
"""What is wrong with a command line, in one line; what it may say, in sections."""

import argparse
from collections.abc import Callable, Sequence
from typing import Any, NoReturn

from srnn_bringup.exit_codes import WRONG_USE
from srnn_bringup.sections import SECTIONS, section_of
from srnn_config.nearest import did_you_mean


class Parser(argparse.ArgumentParser):
    """Says in one line what is wrong with a command line, and shows options in sections."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        """Take what `argparse.ArgumentParser` takes."""
        self._sections: dict[str, argparse._ArgumentGroup] = {}
        self._fill: Callable[[], None] | None = None
        options.setdefault('allow_abbrev', False)
        super().__init__(*arguments, **options)
        self._sections = {title: self.add_argument_group(title) for title in SECTIONS}

    def fill_by(self, fill: Callable[[], None]) -> None:
        """Have arguments added when they are first needed: to import what they are takes time."""
        self._fill = fill

    def fill(self) -> None:
        """Add what `fill_by` has put off."""
        fill, self._fill = self._fill, None
        if fill is not None:
            fill()

    @property
    def has_actions(self) -> bool:
        """Tell whether another command follows."""
        return self._subparsers is not None

    def section(self, title: str) -> 'argparse._ArgumentGroup':
        """Return a section of the help, see `srnn_bringup.sections`."""
        return self._sections[title]

    def add_argument(self, *names: str, **options: Any) -> argparse.Action:
        """Add an argument, to the section that its name belongs to."""
        title = section_of(names)
        if title in self._sections:
            return self._sections[title].add_argument(*names, **options)
        return super().add_argument(*names, **options)

    def error(self, message: str) -> NoReturn:
        """Name the mistake and end with exit code 2."""
        self.exit(WRONG_USE, f'{self.prog}: {message}; see {self.prog} --help\n')

    def parse_known_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse; an unknown option is told of before anything that may be missing."""
        self.fill()
        if args is not None and not self.has_actions:
            self.refuse_unknown([text for text in _before_dashes(args) if self._unknown(text)])
        return super().parse_known_args(args, namespace)

    def refuse_unknown(self, arguments: Sequence[str]) -> None:
        """Name the first argument that nobody knows, with the options there are."""
        if not arguments:
            return
        options = sorted(o for o in self._option_string_actions if o.startswith('--'))
        hint = did_you_mean(arguments[0].partition('=')[0], options)
        self.error(f"unknown argument '{arguments[0]}'{hint}; options: {', '.join(options)}")

    def _unknown(self, text: str) -> bool:
        """Tell whether a text can only be an option, and is none of ours."""
        return text.startswith('--') and text.partition('=')[0] not in self._option_string_actions

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Refuse what is none of the choices, with the one that is nearest."""
        if action.choices is None or value in action.choices:
            return
        valid = [str(choice) for choice in action.choices]
        listed = ', '.join(map(repr, valid))
        hint = did_you_mean(str(value), valid)
        raise argparse.ArgumentError(
            action, f"invalid choice: '{value}'{hint}; choose from {listed}"
        )


def _before_dashes(arguments: Sequence[str]) -> Sequence[str]:
    """Return the arguments before a ``--``, behind which nothing is an option."""
    return arguments[: arguments.index('--')] if '--' in arguments else arguments
