# SPDX-License-Identifier: Apache-2.0
from hypothesis import given
from hypothesis import strategies as st
import numpy as np

from lwr_fri_driver.core.sequence import RESTART, WRAP, Arrival, SequenceWatch

STARTS = st.integers(0, WRAP - 1)


@given(STARTS, st.integers(1, 500))
def test_packets_in_order_are_all_fresh_also_over_the_wrap(start, count):
    watch = SequenceWatch()
    for n in range(count):
        assert watch.judge((start + n) % WRAP) is Arrival.FRESH
        assert watch.elapsed == 1
    assert watch.lost == 0


@given(STARTS, st.lists(st.integers(1, 1000), min_size=1, max_size=50))
def test_missing_packets_are_counted_and_the_time_that_passed_is_known(start, gaps):
    watch = SequenceWatch()
    watch.judge(start)
    sequence = start
    for gap in gaps:
        sequence += gap
        assert watch.judge(sequence % WRAP) is Arrival.FRESH
        assert watch.elapsed == gap
    assert watch.lost == sum(gaps) - len(gaps)


@given(STARTS, st.integers(0, 2**32 - 1))
def test_in_any_disorder_each_packet_is_fresh_once_and_what_is_fresh_only_grows(start, seed):
    """Packets wait up to four cycles, and every fourth comes twice."""
    rng = np.random.default_rng(seed)
    times = np.arange(200) + rng.uniform(0.0, 4.0, 200)
    copies = times[::4] + rng.uniform(0.0, 4.0, 50)
    numbers = np.concatenate([np.arange(200), np.arange(0, 200, 4)])
    order = numbers[np.argsort(np.concatenate([times, copies]))].tolist()
    watch = SequenceWatch()
    fresh = [n for n in order if watch.judge((start + n) % WRAP) is Arrival.FRESH]
    assert fresh == sorted(set(fresh))
    assert watch.counts[Arrival.RESTARTED] == 0
    assert sum(watch.counts.values()) == 250


def test_a_frozen_counter_is_never_anything_but_a_double():
    watch = SequenceWatch()
    watch.judge(7)
    assert {watch.judge(7) for _ in range(1000)} == {Arrival.DUPLICATE}


@given(st.integers(RESTART, WRAP // 2))
def test_a_sender_that_counts_anew_is_believed_after_a_few_packets(before):
    watch = SequenceWatch()
    watch.judge(before)
    arrivals = [watch.judge(n) for n in range(RESTART + 3)]
    assert arrivals.index(Arrival.RESTARTED) == RESTART - 1
    assert set(arrivals[RESTART:]) == {Arrival.FRESH}
