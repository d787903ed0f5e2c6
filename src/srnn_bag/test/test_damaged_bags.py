# SPDX-License-Identifier: Apache-2.0
"""A recorder that is killed loses nothing that it has flushed; damage is never taken for data."""

from pathlib import Path
import signal
import subprocess
import sys

from hypothesis import given, settings
from hypothesis import strategies as st
import pytest
from sample_bags import samples, write

from srnn_bag import open_bag
from srnn_bag.errors import BagFormatError

MESSAGES = samples(60)
WRITE = """
import sys
sys.path.insert(0, sys.argv[2])
from pathlib import Path
from sample_bags import begin, put, samples
writer = begin(Path(sys.argv[1]))
flushed = samples(40)
for message in flushed:
    put(writer, message)
writer.flush()
put(writer, samples(41)[-1])
print('flushed', flush=True)
sys.stdin.read()
"""


def test_a_killed_writer_leaves_all_that_it_has_flushed(tmp_path):
    command = [sys.executable, '-c', WRITE, str(tmp_path / 'bag'), str(Path(__file__).parent)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        try:
            assert process.stdout.readline() == b'flushed\n'
        finally:
            process.send_signal(signal.SIGKILL)
            process.wait(timeout=10)
    bag = open_bag(tmp_path / 'bag')
    assert not bag.complete
    assert list(bag.messages()) == samples(40)
    assert bag.attachments == {'scene.yaml': b'name: sample\n'}


def read(file):
    """Return the messages of a file, or the words that refuse it."""
    try:
        return list(open_bag(file).messages())
    except BagFormatError as error:
        return str(error)


def refused(found, file):
    return isinstance(found, str) and str(file) in found and '\n' not in found


@pytest.fixture(scope='module')
def whole(tmp_path_factory):
    (file,) = write(tmp_path_factory.mktemp('bags') / 'run', MESSAGES, 7).glob('*.mcap')
    return file


@settings(max_examples=200)
@given(share=st.floats(0.0, 1.0))
def test_what_is_left_of_a_cut_bag_is_its_beginning(whole, tmp_path_factory, share):
    file, content = tmp_path_factory.mktemp('cut') / 'cut.mcap', whole.read_bytes()
    file.write_bytes(content[: int(share * len(content))])
    found = read(file)
    assert refused(found, file) or found == MESSAGES[: len(found)]


@settings(max_examples=300)
@given(share=st.floats(0.0, 1.0, exclude_max=True), bit=st.integers(0, 7))
def test_a_flipped_bit_is_never_taken_for_data(whole, tmp_path_factory, share, bit):
    """It may be in the frame around the messages; then they are as they were, or refused."""
    damaged = bytearray(whole.read_bytes())
    damaged[int(share * len(damaged))] ^= 1 << bit
    file = tmp_path_factory.mktemp('bit') / 'bit.mcap'
    file.write_bytes(damaged)
    found = read(file)
    known = {(m.sequence, m.data) for m in MESSAGES}
    assert refused(found, file) or {(m.sequence, m.data) for m in found} <= known
