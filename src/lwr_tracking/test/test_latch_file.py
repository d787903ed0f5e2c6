# SPDX-License-Identifier: Apache-2.0
"""A stop outlives the process; what cannot be read is a stop as well."""

from hypothesis import given
from hypothesis import strategies as st
import pytest

from lwr_tracking.core.failsafe import Condition, decide
from lwr_tracking.latch_file import LatchFile


@given(conditions=st.sets(st.sampled_from(list(Condition))))
def test_what_latches_comes_back(tmp_path_factory, conditions):
    file = LatchFile(tmp_path_factory.mktemp('latch') / 'latch')
    together = Condition.NONE
    for condition in conditions:
        together |= condition
    file.write(together)
    assert file.read() == decide(together).latched


def test_nothing_latched_leaves_no_file(tmp_path):
    file = LatchFile(tmp_path / 'latch')
    assert file.read() is Condition.NONE
    file.write(Condition.STOPPED)
    assert [path.name for path in tmp_path.iterdir()] == ['latch']
    file.write(Condition.PAUSED)
    assert not list(tmp_path.iterdir())
    file.write(Condition.NONE)


@pytest.mark.parametrize('content', [b'', b'\xff\xfe', b'NO_SUCH', b'CONTACT', b'STOPPED' * 9999])
def test_what_cannot_be_read_is_a_stop(tmp_path, content):
    file = LatchFile(tmp_path / 'latch')
    file.path.write_bytes(content)
    assert file.read() is Condition.STOPPED


def test_a_directory_in_its_place_is_a_stop(tmp_path):
    (tmp_path / 'latch').mkdir()
    assert LatchFile(tmp_path / 'latch').read() is Condition.STOPPED


def test_without_a_path_nothing_is_kept():
    file = LatchFile(None)
    file.write(Condition.STOPPED)
    assert file.read() is Condition.NONE
