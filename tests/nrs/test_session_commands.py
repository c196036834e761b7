"""Commands through the session: retries, refusals, and where the zero moved."""

import pytest

from drivers.errors import CommandRefusedError, OverloadError, SensorError
from drivers.nrs.session import Session
from drivers.protocol.nrs_can import FAULT, OVERLOAD, SATURATED, TARED, VALID, Identifiers
from drivers.protocol.nrs_command import Opcode, Reply, Result, decode_command, encode_reply
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


@pytest.fixture
def session():
    session = Session(node=1, fd=False, period=MS, max_age=10 * MS)
    session.start()
    session.take([encode_heartbeat(IDS, NodeState.PRE_OPERATIONAL)], 0)
    return session


def reply_to(frame, result=Result.OK, values=()):
    command = decode_command(frame.data)
    return encode_reply(IDS, Reply(command.opcode, command.seq, result, values))


def streaming(session):
    session.take([reply_to(session.due(0), values=(1,))], 0)
    session.take([encode_status(IDS, Status(StatusBit.TRANSMIT_ON, 25.0, 0, 0))], 0)


def deliver(session, numbers, flags=VALID):
    for number in numbers:
        for frame in encode_pair(IDS, [1] * 6, flags, number):
            session.take([frame], number * MS)


def test_start_waits_until_the_node_is_up():
    session = Session(node=1, fd=False, period=MS, max_age=10 * MS)
    session.start()
    assert session.due(0) is None
    session.take([encode_heartbeat(IDS, NodeState.BOOT)], 100 * MS)
    assert session.due(200 * MS) is None
    session.take([encode_heartbeat(IDS, NodeState.PRE_OPERATIONAL)], 400 * MS)
    assert decode_command(session.due(400 * MS).data).opcode == Opcode.TRANSMIT


def test_a_node_that_never_shows_up_is_reported():
    session = Session(node=3, fd=False, period=MS, max_age=10 * MS)
    session.start()
    session.due(0)
    with pytest.raises(CommandRefusedError, match="node 3 has sent no heartbeat for 3 s"):
        session.due(3001 * MS)


def test_an_unanswered_command_is_sent_three_times_with_one_sequence_number(session):
    sent = [frame for t in range(0, 300, 8) if (frame := session.due(t * MS))]
    assert len(sent) == 3
    assert len({frame.data for frame in sent}) == 1
    with pytest.raises(CommandRefusedError, match="no answer to 3 tries"):
        session.due(400 * MS)


def test_a_refusal_is_raised_with_its_reason(session):
    streaming(session)
    session.begin_tare(50)
    session.take([reply_to(session.due(8 * MS), Result.WRONG_STATE)], 9 * MS)
    with pytest.raises(CommandRefusedError, match=r"TARE.*WRONG_STATE"):
        session.due(16 * MS)
    assert not session.tare_pending


def test_a_reply_with_another_sequence_number_settles_nothing(session):
    command = decode_command(session.due(0).data)
    late = Reply(command.opcode, command.seq - 1, Result.OK, (1,))
    session.take([encode_reply(IDS, late)], MS)
    assert session.due(100 * MS) is not None


def test_a_tare_drops_the_samples_that_were_on_the_old_zero(session):
    streaming(session)
    deliver(session, range(5))
    session.begin_tare(3)
    request = session.due(5 * MS)
    deliver(session, range(5, 8))
    deliver(session, range(8, 13), VALID | TARED)
    session.take([reply_to(request, values=(8,))], 13 * MS)
    reading = session.reading(13 * MS)
    assert (len(reading.samples), reading.tared) == (5, True)


def test_a_tare_waits_for_the_samples_it_averages(session):
    streaming(session)
    session.begin_tare(500)
    assert session.due(0) is not None
    assert session.due(599 * MS) is None
    assert session.due(600 * MS) is not None


def test_a_tare_of_no_samples_is_the_callers_error(session):
    with pytest.raises(ValueError, match="at least one sample"):
        session.begin_tare(0)


@pytest.mark.parametrize("flag", [OVERLOAD, SATURATED])
def test_one_sample_out_of_range_spoils_the_reading(session, flag):
    streaming(session)
    deliver(session, range(4))
    deliver(session, [4], VALID | flag)
    deliver(session, range(5, 8))
    with pytest.raises(OverloadError, match="sample 4 is out of range"):
        session.reading(8 * MS)
    deliver(session, [8])
    assert session.reading(8 * MS).counter == 8


@pytest.mark.parametrize("flags", [0, VALID | FAULT])
def test_a_faulty_gauge_gives_no_wrench(session, flags):
    streaming(session)
    deliver(session, [0], flags)
    with pytest.raises(SensorError, match="gauges are faulty"):
        session.reading(0)


@pytest.mark.parametrize("length", [0, 7])
def test_a_wrong_length_is_counted_as_malformed(session, length):
    streaming(session)
    frame = encode_pair(IDS, [1] * 6, VALID, 0)[0]
    session.take([frame._replace(data=frame.data[:length])], 0)
    assert session.assembler.malformed == 1


def test_frames_of_others_are_counted_as_foreign(session):
    frame = encode_pair(Identifiers.of(2), [1] * 6, VALID, 0)[0]
    session.take([frame], 0)
    assert (session.foreign, session.assembler.pairs) == (1, 0)
