# SPDX-License-Identifier: Apache-2.0
"""The directory of an experiment: finished trials, and its report in all its forms."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from srnn_bringup.speech import write_document
from srnn_experiments.store import TrialStore


def open_store(directory: Path) -> TrialStore:
    """Return the finished trials of a directory, which is made if need be.

    Raises:
        StoreError: the file of trials is not one of ours.
        OSError: it cannot be read or written.

    """
    directory.mkdir(parents=True, exist_ok=True)
    return TrialStore(directory / 'trials.jsonl')


def write_results(
    directory: Path, name: str, report: Mapping[str, Any], text: str, table: str | None = None
) -> None:
    """Write a report as ``name.json`` and ``name.md``, and a table as ``name.csv``.

    Raises:
        OSError: a file cannot be written.

    """
    path = directory / name
    write_document(path.with_suffix('.json'), report)
    path.with_suffix('.md').write_text(text, encoding='utf-8')
    if table is not None:
        path.with_suffix('.csv').write_text(table, encoding='utf-8')
