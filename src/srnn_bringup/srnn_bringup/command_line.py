# SPDX-License-Identifier: Apache-2.0
"""What is wrong with a command line, in one line."""

import argparse
from collections.abc import Sequence
import difflib
from typing import NoReturn

WRONG_USE = 2
"""Exit code after a wrong command line or file."""


class Parser(argparse.ArgumentParser):
    """Says in one line what is wrong with a command line."""

    def error(self, message: str) -> NoReturn:
        """Name the mistake and end with exit code 2."""
        self.exit(WRONG_USE, f'{self.prog}: {message}; see {self.prog} --help\n')

    def refuse_unknown(self, arguments: Sequence[str]) -> None:
        """Name the first argument that nobody knows, with the options there are."""
        if not arguments:
            return
        options = sorted(o for o in self._option_string_actions if o.startswith('--'))
        near = difflib.get_close_matches(arguments[0].partition('=')[0], options, n=1)
        hint = f" (did you mean '{near[0]}'?)" if near else ''
        self.error(f"unknown argument '{arguments[0]}'{hint}; options: {', '.join(options)}")
