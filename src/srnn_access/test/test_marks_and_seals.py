# SPDX-License-Identifier: Apache-2.0
from hypothesis import example, given
from hypothesis import strategies as st

from srnn_access import Key, Mark, Seal, Source
from srnn_access.mark import parse

TIMES = st.integers(0, 2**64 - 1)
SOURCES = st.integers(1, 2**64 - 1)
NUMBERS = st.integers(1, 10**19 - 1)
CODES = st.text('0123456789abcdef', min_size=32, max_size=32)
PLAIN = st.tuples(SOURCES, NUMBERS).map(lambda fields: Mark(*fields))
SEALED = st.tuples(SOURCES, NUMBERS, TIMES, CODES).map(lambda fields: Mark(*fields))
MARKS = PLAIN | SEALED
KEY = Key(bytes(range(32)))


@given(MARKS)
def test_a_mark_comes_back_from_its_text(mark):
    assert parse(mark.text()) == mark
    assert mark.text().startswith(mark.claim())


@given(st.text(max_size=90) | MARKS.map(lambda mark: mark.text() + '0'))
@example('0000000000000000.1')
@example('0000000000000001.0')
@example('0000000000000001.01')
@example('0000000000000001.1\n')
@example('000000000000000١.1')
@example('0000000000000001.1.0000000000000001')
@example('0000000000000001.1.0000000000000001.' + 'A' * 32)
def test_garbage_is_no_mark_and_every_mark_has_one_text(text):
    mark = parse(text)
    assert mark is None or mark.text() == text


def test_nobody_can_pass_for_a_sender_without_a_mark():
    assert parse('0000000000000000.1') is None
    assert parse('0000000000000001.1') is not None


def test_later_senders_have_greater_numbers_that_do_not_change():
    first, second = Source(), Source()
    assert first.epoch(5) == first.epoch(9) == 5
    assert second.epoch(9) == 9
    assert Source().epoch(0) > 0


@given(st.binary(max_size=200), st.text(max_size=20))
def test_the_code_of_a_message_fits_it(content, topic):
    seal = Seal(KEY, topic)
    code = seal.code(content)
    assert len(code) == 32
    assert seal.fits(code, content)
    assert parse(Mark(1, 1, 0, code).text()).code == code


@given(st.binary(min_size=1, max_size=100), st.data())
def test_any_other_bit_of_content_key_or_code_does_not_fit(content, data):
    code = Seal(KEY, '/segment').code(content)

    def flipped(value):
        bit = data.draw(st.integers(0, 8 * len(value) - 1))
        number = int.from_bytes(value, 'little') ^ 1 << bit
        return number.to_bytes(len(value), 'little')

    assert not Seal(KEY, '/segment').fits(code, flipped(content))
    assert not Seal(Key(flipped(KEY.secret)), '/segment').fits(code, content)
    assert not Seal(KEY, '/segment').fits(flipped(bytes.fromhex(code)).hex(), content)


@given(st.text(max_size=10), st.text(max_size=10), st.binary(max_size=20))
def test_a_code_is_for_one_topic_only(one, other, content):
    fits = Seal(KEY, other).fits(Seal(KEY, one).code(content), content)
    assert fits == (one == other)
    # Nor can the end of a name be taken for the beginning of the content.
    assert not Seal(KEY, one).fits(Seal(KEY, one + 'x').code(content), b'x' + content)


def test_codes_never_change():
    """Else an updated node would refuse those that were not."""
    code = '30fb5af820fa94dfc6ffe73b8e6e2bba'
    assert Seal(KEY, '/segment').code(b'content') == code
