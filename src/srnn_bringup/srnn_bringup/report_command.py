# SPDX-License-Identifier: Apache-2.0
"""`srnn report`: a recorded run, or the results of an experiment, as one web page."""

import argparse
from pathlib import Path

from srnn_bag import metadata
from srnn_bringup.errors import ChoiceError
from srnn_bringup.options import new_file


def add_report(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        'source', type=Path, metavar='BAG_OR_DIR',
        help='recording, or directory that `srnn experiment` has written to',
    )
    parser.add_argument(
        '--out', type=new_file, metavar='FILE', help='page to write (default: SOURCE.html)'
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    source: Path = options.source
    out = options.out or Path(f'{source.resolve().name}.html')
    out.write_text(_page(source), encoding='utf-8')
    print(f'report: {out}')
    return 0


def _page(source: Path) -> str:
    if source.suffix == '.mcap' or (source / metadata.FILE).exists() or any(source.glob('*.mcap')):
        from srnn_bringup.page.bag_run import read_run
        from srnn_bringup.page.run_page import run_page

        return run_page(read_run(source))
    texts = sorted(source.glob('*.md')) if source.is_dir() else []
    if not texts:
        raise ChoiceError(
            f'{source}: is no recording, and no directory with results of an experiment (*.md)'
        )
    from srnn_bringup.page import html
    from srnn_bringup.page.markdown import from_markdown

    parts = [
        part
        for text in texts for part in from_markdown(text.read_text(encoding='utf-8'), source)
    ]  # fmt: skip
    return html.page(source.resolve().name, parts)
