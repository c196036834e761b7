"""What the TCP driver promises, by bytes and arm time alone."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.errors import (
    BlankSignalError,
    CommandRefusedError,
    FlatSignalError,
    NotReadyError,
    OverloadError,
    ProtocolError,
    StaleSampleError,
)
from drivers.interfaces import Freshness
from drivers.nrs.plausibility import TYPICAL
from drivers.nrs.tcp_session import CATCH_UP, NRS_6050_D80, TcpSession
from drivers.protocol.nrs_tcp import Kind, encode, encode_wrench

MS = 1_000_000


def wrench(number):
    """One that names its sample, and stays in range."""
    return (number % 400 + 1.0, 0.5, -0.25, 0.125, -1.0, 2.0)


def octets(numbers):
    return b"".join(encode_wrench(wrench(number)) for number in numbers)


def started():
    session = TcpSession(MS, 10 * MS, NRS_6050_D80, TYPICAL)
    session.connected()
    session.start()
    for kind in (Kind.PERIOD, Kind.TRANSMIT):
        assert session.due(0)
        session.take(encode(kind, 0), 0)
    return session


@pytest.fixture
def session():
    return started()


def test_commands_go_one_at_a_time_each_after_the_answer_to_the_last():
    session = TcpSession(5 * MS, 10 * MS, NRS_6050_D80, TYPICAL)
    session.start()
    assert session.due(0) == encode(Kind.PERIOD, 5)
    assert session.due(1) == b""
    session.take(encode(Kind.PERIOD, 0), 2)
    assert session.due(3) == encode(Kind.TRANSMIT, 1)
    session.take(encode(Kind.TRANSMIT, 77), 4)  # what the third byte means is not public
    assert session.due(5) == b""


@given(st.lists(st.tuples(st.integers(0, 30), st.integers(0, 49)), min_size=1, max_size=40))
def test_however_the_stream_stalls_every_sample_is_given_once_and_never_an_old_one(stalls):
    session, held, seen, t, number = started(), b"", [], 0, 0
    for stall, cut in stalls:
        for _ in range(stall + 1):
            t += 1
            held += octets([number])
            number += 1
        arrived, held = held[: len(held) - cut], held[len(held) - cut :]
        session.take(arrived, t * MS)
        try:
            reading = session.reading(t * MS)
        except (NotReadyError, StaleSampleError):
            continue
        assert reading.wrench == wrench(reading.counter)
        assert (t - 1 - reading.counter) * MS <= 10 * MS + MS
        seen.append(reading.counter)
    assert seen == sorted(seen)


def test_a_burst_that_was_held_is_stale_until_it_has_caught_up(session):
    session.take(octets(range(10)), 10 * MS)
    session.reading(10 * MS)
    session.take(octets(range(10, 18)), 40 * MS)  # 22 more are on their way
    with pytest.raises(StaleSampleError):
        session.reading(40 * MS)
    session.take(octets(range(18, 40)), 41 * MS)
    assert session.reading(41 * MS).freshness is Freshness.OK


def test_samples_that_the_sensor_lost_are_counted_once_nothing_catches_up(session):
    session.take(octets(range(10)), 10 * MS)
    lost = 50
    end = 10 + lost + CATCH_UP // MS + 20
    for t in range(10 + lost, end):
        session.take(octets([t]), (t + 1) * MS)
    assert session.gaps == pytest.approx(lost, abs=1)
    assert session.reading(end * MS).freshness is Freshness.OK


def test_samples_from_before_the_start_are_another_rates_and_dropped():
    session = TcpSession(MS, 10 * MS, NRS_6050_D80, TYPICAL)
    session.connected()
    session.start()
    session.take(octets(range(20)), 0)
    with pytest.raises(NotReadyError):
        session.reading(0)


def test_a_tare_takes_off_what_the_sensors_own_has_left(session):
    session.take(octets(range(8)), 8 * MS)
    session.begin_tare(4)
    assert session.due(8 * MS) == encode(Kind.TARE, 1)
    old, new = octets([8, 9]), octets([10, 11, 12, 13, 14, 15])
    session.take(old + encode(Kind.TARE, 0) + new, 16 * MS)
    assert not session.tare_pending
    reading = session.reading(16 * MS)
    mean = (wrench(10)[0] + wrench(13)[0]) / 2
    assert reading.tared
    assert [sample[0] for sample in reading.samples] == [wrench(k)[0] - mean for k in (13, 14, 15)]
    assert reading.wrench[1:] == (0.0,) * 5


def test_a_tare_whose_samples_do_not_come_is_an_error(session):
    session.take(octets(range(8)), 8 * MS)
    session.begin_tare(100)
    session.due(8 * MS)
    session.take(encode(Kind.TARE, 0) + octets(range(8, 16)), 16 * MS)
    with pytest.raises(CommandRefusedError, match="92 of 100 samples"):
        session.due(5_000 * MS)
    assert not session.tare_pending


def test_a_command_without_an_answer_is_an_error():
    session = TcpSession(MS, 10 * MS, NRS_6050_D80, TYPICAL)
    session.start()
    session.due(0)
    with pytest.raises(CommandRefusedError, match="PERIOD 1: no answer for 2 s"):
        session.due(2_001 * MS)


def test_an_overload_is_refused_even_when_it_is_over_at_the_read(session):
    session.take(encode_wrench((0.0, 0.0, -501.0, 0.0, 0.0, 0.0)) + octets([1]), 2 * MS)
    with pytest.raises(OverloadError, match="-501"):
        session.reading(2 * MS)
    session.take(octets([2]), 3 * MS)
    assert session.reading(3 * MS).freshness is Freshness.OK


@pytest.mark.parametrize(
    ("value", "error"), [((0.0,) * 6, BlankSignalError), ((1.0,) * 6, FlatSignalError)]
)
def test_a_dead_or_stuck_sensor_is_refused(session, value, error):
    session.take(encode_wrench(value) * 20, 20 * MS)
    with pytest.raises(error):
        session.reading(20 * MS)


def test_bent_samples_are_counted_and_dropped(session):
    session.take(octets([0]) + b"\x05\x06abc" + octets([1]), 2 * MS)
    assert (session.received, session.malformed) == (2, 1)


def test_a_stream_that_is_not_the_protocol_is_an_error(session):
    with pytest.raises(ProtocolError, match="length 0"):
        session.take(b"\x00", MS)


@pytest.mark.parametrize("period", [0, 500_000, 1_500_000, 201 * MS])
def test_a_rate_that_the_protocol_cannot_ask_for_is_refused(period):
    with pytest.raises(ValueError, match="from 1 to 200"):
        TcpSession(period, 10 * MS, NRS_6050_D80, TYPICAL)


def test_a_tare_on_no_samples_is_refused(session):
    with pytest.raises(ValueError, match="at least one"):
        session.begin_tare(0)
