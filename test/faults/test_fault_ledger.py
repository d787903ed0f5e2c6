# SPDX-License-Identifier: Apache-2.0
"""The account of faults counts what failed, and shows the worst of each."""

from contextlib import suppress

from fault_ledger import FaultLedger
import pytest


def test_a_fault_whose_test_fails_is_not_survived():
    ledger = FaultLedger(repeats=2)
    with ledger.injection(4, 'tracker killed', bound_ms=20.0) as first:
        first.deviation_mm, first.reaction_ms = 3.0, 12.0
        first.force = 7.1
    with suppress(ZeroDivisionError), ledger.injection(4, 'tracker killed') as second:
        second.deviation_mm = 1.0 / 0.0
    assert [entry.survived for entry in ledger.injections] == [True, False]
    row, *_, last = ledger.table()[2:]
    assert row == '| 4 | tracker killed | 2 | 1 | 3.0 mm |  | 7 N | 12.0 ms | 20 ms |'
    assert last == '1 faults, 1 of 2 survived'


def test_a_late_reaction_is_not_survived():
    ledger = FaultLedger(repeats=1)
    with pytest.raises(AssertionError), ledger.injection(7, 'link cut', bound_ms=20.0) as entry:
        entry.reaction_ms = 21.0
    assert not ledger.injections[0].survived
