"""What the driver promises whatever the wire does to frames: whole wrenches, honest ages."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drivers.errors import NotReadyError, SensorResetError, StaleSampleError
from drivers.interfaces import Freshness
from drivers.nrs.session import Session
from drivers.protocol.nrs_can import FORCE_LSB, TARED, TORQUE_LSB, VALID, Identifiers
from drivers.protocol.nrs_sample import encode_pair
from drivers.protocol.nrs_status import (
    NodeState,
    Status,
    StatusBit,
    encode_heartbeat,
    encode_status,
)

IDS = Identifiers.of(1)
MS = 1_000_000
MAX_AGE = 10 * MS
LONGEST_DELAY = 30

fate = st.one_of(
    st.just([0]),  # on time
    st.just([]),  # lost
    st.just([0, 3]),  # doubled
    st.lists(st.integers(0, LONGEST_DELAY), min_size=1, max_size=2),  # late, perhaps twice
)


def counts(number):
    """Counts that name the sample in all six axes, and are never zero."""
    return [number + 1, number + 2, number + 3, -number - 1, -number - 2, -number - 3]


def wrench(number):
    lsb = [FORCE_LSB] * 3 + [TORQUE_LSB] * 3
    return tuple(c * k for c, k in zip(counts(number), lsb, strict=True))


def pair(number, flags=VALID):
    return encode_pair(IDS, counts(number), flags, number)


def status(sent, bits=StatusBit.TRANSMIT_ON):
    return encode_status(IDS, Status(bits, 25.0, 0, sent))


@pytest.fixture
def session():
    return started()


def started():
    session = Session(node=1, fd=False, period=MS, max_age=MAX_AGE)
    session.start()
    session.take([status(0)], 0)
    return session


def feed(session, numbers, flags=VALID):
    """Deliver samples on time: sample k at k ms."""
    for number in numbers:
        for frame in pair(number, flags):
            session.take([frame], number * MS)


@settings(deadline=None)
@given(st.lists(st.tuples(fate, fate), min_size=1, max_size=120), st.sampled_from([2, 8]))
def test_every_wrench_was_sent_whole_and_is_as_young_as_it_says(fates, poll_every):
    session = started()
    arrivals = sorted(
        (number + delay, order, number, half)
        for order, (number, half, delay) in enumerate(
            (number, half, delay)
            for number, halves in enumerate(fates)
            for half in (0, 1)
            for delay in halves[half]
        )
    )
    last = -1
    for now in range(0, len(fates) + 2 * LONGEST_DELAY, poll_every):
        while arrivals and arrivals[0][0] <= now:
            _, _, number, half = arrivals.pop(0)
            session.take([pair(number)[half]], now * MS)
        try:
            reading = session.reading(now * MS)
        except (NotReadyError, StaleSampleError):
            continue
        assert reading.wrench == wrench(reading.counter)
        assert set(reading.samples) <= {wrench(n) for n in range(last + 1, reading.counter + 1)}
        assert (reading.freshness is Freshness.OK) == (reading.counter > last)
        # No sample is delayed by less than 0 nor anchored later than the longest delay and poll.
        true_age = now - reading.counter
        assert true_age * MS <= MAX_AGE + (LONGEST_DELAY + 3 + poll_every) * MS
        last = reading.counter


@settings(deadline=None)
@given(st.lists(st.booleans(), min_size=1, max_size=100))
def test_pairs_and_gaps_add_up_to_what_was_sent(kept):
    session = started()
    kept = [*kept, True]
    feed(session, [number for number, keep in enumerate(kept) if keep])
    assert session.assembler.pairs == sum(kept)
    assert session.assembler.gaps == len(kept) - sum(kept)
    assert session.assembler.torn == session.assembler.duplicates == 0


@settings(deadline=None)
@given(st.integers(1, 8), st.data())
def test_samples_of_one_batch_may_come_in_any_order(count, data):
    session = started()
    feed(session, range(3))
    frames = [frame for number in range(3, 3 + count) for frame in pair(number)]
    at = data.draw(st.permutations(range(len(frames))).map(near))
    session.take([frames[n] for n in at], (3 + count) * MS)
    reading = session.reading((3 + count) * MS)
    assert reading.samples == tuple(wrench(number) for number in range(3 + count))
    assert reading.counter == 2 + count
    assert session.assembler.gaps == session.assembler.torn == session.assembler.duplicates == 0


def near(order):
    """The order within each group of two samples: more halves than these are not waited for."""
    groups = [sorted(order)[n : n + 4] for n in range(0, len(order), 4)]
    ranked = {n: order.index(n) for n in order}
    groups = [sorted(group, key=ranked.__getitem__) for group in groups]
    return [n for group in groups for n in group]


def test_a_sample_that_is_later_than_its_batch_is_dropped(session):
    feed(session, [0, 1])
    session.take([*pair(3)], 3 * MS)
    session.take([*pair(2), *pair(4)], 4 * MS)
    reading = session.reading(4 * MS)
    assert reading.samples == tuple(wrench(number) for number in (0, 1, 3, 4))
    assert session.assembler.gaps == 1


def test_halves_that_lost_their_partner_are_never_mixed(session):
    for number in range(0, 40, 2):
        session.take([pair(number)[0]], number * MS)
        session.take([pair(number + 1)[1]], (number + 1) * MS)
    with pytest.raises(NotReadyError):
        session.reading(40 * MS)
    assert session.assembler.torn == 38


def test_a_half_from_a_whole_counter_turn_ago_is_no_partner(session):
    feed(session, range(10))
    session.take([pair(10)[0]], 10 * MS)
    session.take([status(266)], 265 * MS)
    session.take([pair(266)[1]], 266 * MS)
    assert session.assembler.pairs == 10


def test_a_duplicated_sample_is_counted_and_not_given_again(session):
    feed(session, [0, 1, 1, 1])
    assert session.reading(MS).samples == (wrench(0), wrench(1))
    assert session.assembler.duplicates == 4


def test_the_last_sample_is_held_until_the_limit_and_then_refused(session):
    feed(session, range(20))
    assert session.reading(19 * MS).freshness is Freshness.OK
    held = session.reading(29 * MS)
    assert (held.freshness, held.samples, held.wrench) == (Freshness.HELD, (), wrench(19))
    with pytest.raises(StaleSampleError, match=r"10\.0 ms old"):
        session.reading(29 * MS + 40_000)


def test_a_frozen_counter_is_stale_although_frames_arrive(session):
    feed(session, range(20))
    for t in range(20, 31):
        for frame in pair(19):
            session.take([frame], t * MS)
    with pytest.raises(StaleSampleError):
        session.reading(31 * MS)


def test_a_burst_held_back_is_as_old_as_it_is_not_as_it_arrived(session):
    feed(session, range(20))
    for number in range(20, 60):
        for frame in pair(number):
            session.take([frame], 100 * MS)
    with pytest.raises(StaleSampleError, match=r"sample 59 is (40|41)\.\d ms old"):
        session.reading(100 * MS)


@pytest.mark.parametrize("lost", [130, 256, 300, 1000])
def test_numbers_are_right_after_an_outage_longer_than_the_counter(session, lost):
    feed(session, range(20))
    back = 20 + lost
    feed(session, [back])
    session.take([status(back + 1)], back * MS)
    feed(session, [back + 1])
    assert session.reading((back + 1) * MS).counter == back + 1
    assert session.assembler.gaps == lost + 1


@pytest.mark.parametrize("ppm", [-100, 100])
def test_clock_drift_does_not_look_like_delay(session, ppm):
    for number in range(100_000):
        t = number * (MS + ppm)
        if number % 100 == 0:
            session.take([status(number)], t)
        for frame in pair(number % 256):
            session.take([frame], t)
        if number % 5000 == 0 and number:
            assert session.reading(t).age <= MS


def test_a_boot_heartbeat_ends_trust_until_started_again(session):
    feed(session, range(20), VALID | TARED)
    session.take([encode_heartbeat(IDS, NodeState.BOOT)], 20 * MS)
    feed(session, range(20, 30))
    with pytest.raises(SensorResetError):
        session.reading(30 * MS)
    session.start()
    session.take([status(0)], 40 * MS)
    for frame in pair(0):
        session.take([frame], 41 * MS)
    assert not session.reading(41 * MS).tared


def test_a_sample_count_that_goes_back_is_a_reset_too(session):
    feed(session, range(200))
    session.take([status(200)], 200 * MS)
    session.take([status(5)], 205 * MS)
    with pytest.raises(SensorResetError):
        session.reading(206 * MS)
