# SPDX-License-Identifier: Apache-2.0
"""Everything that is looked at, and what it comes to."""

from collections.abc import Callable, Iterator, Mapping, Sequence
import os
from typing import Any

from srnn_bringup.doctor.finding import Finding, Verdict
from srnn_bringup.doctor.machine import machine
from srnn_bringup.doctor.middleware import middleware
from srnn_bringup.doctor.rights import rights
from srnn_bringup.doctor.software import software
from srnn_bringup.exit_codes import DONE, FAILED


def examine(environ: Mapping[str, str] = os.environ) -> Iterator[Finding]:
    """Yield everything worth looking at."""
    yield from software(environ)
    yield from rights()
    yield from machine(environ)
    yield from middleware(environ)


def run_doctor(say: Callable[[str], None]) -> tuple[int, dict[str, Any]]:
    """Say what was found.

    Returns:
        Exit code, 0 when all that is needed works, else 1; and the findings for JSON.

    """
    findings = []
    for finding in examine():
        say(finding.line())
        findings.append(finding)
    say(_closing(findings))
    failed = any(finding.verdict is Verdict.FAIL for finding in findings)
    found = [finding.document() for finding in findings]
    return FAILED if failed else DONE, {'ok': not failed, 'findings': found}


def _closing(findings: Sequence[Finding]) -> str:
    verdicts = [finding.verdict for finding in findings]
    counts = ', '.join(f'{verdicts.count(v)} {v.value}' for v in Verdict)
    return f'{len(findings)} findings: {counts}'
