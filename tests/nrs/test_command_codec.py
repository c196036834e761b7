"""Commands, replies and status against the DBC, and against garbage."""

from contextlib import suppress
from pathlib import Path

import cantools
import pytest
from hypothesis import given
from hypothesis import strategies as st

import drivers.protocol
from drivers.errors import ProtocolError
from drivers.protocol.nrs_can import Identifiers
from drivers.protocol.nrs_command import (
    Command,
    Opcode,
    Reply,
    Result,
    decode_command,
    decode_reply,
    encode_command,
    encode_reply,
)
from drivers.protocol.nrs_status import (
    Emergency,
    EmergencyCode,
    NodeState,
    Status,
    StatusBit,
    decode_emergency,
    decode_heartbeat,
    decode_status,
    encode_emergency,
    encode_heartbeat,
    encode_status,
)

IDS = Identifiers.of(1)

COMMANDS = [
    (Command(Opcode.SET_FILTER, 1, (1000,)), {"C_CutoffHz": 100.0}),
    (Command(Opcode.TRANSMIT, 2, (1,)), {"C_Transmit": 1}),
    (Command(Opcode.SET_PERIOD, 3, (200,)), {"C_PeriodMs": 200}),
    (Command(Opcode.TARE, 5, (1, 500)), {"C_TareMode": 1, "C_TareSamples": 500}),
    (Command(Opcode.GET_TARE, 6, (4,)), {"C_TareAxis": 4}),
    (Command(Opcode.GET_FULL_SCALE, 7, (2,)), {"C_FsAxis": 2}),
    (Command(Opcode.GET_SERIAL, 8, (3,)), {"C_SerialPart": 3}),
    (Command(Opcode.RESET, 9, (0xB007,)), {"C_ResetMagic": 0xB007}),
]
REPLIES = [
    (Reply(Opcode.SET_FILTER, 1, Result.OK, (5,)), {"R_CutoffHz": 0.5}),
    (Reply(Opcode.TRANSMIT, 2, Result.OK, (0,)), {"R_Transmit": 0}),
    (Reply(Opcode.SET_PERIOD, 3, Result.OK, (10,)), {"R_PeriodMs": 10}),
    (Reply(Opcode.TARE, 4, Result.OK, (200,)), {"R_TareCounter": 200}),
    (Reply(Opcode.GET_TARE, 5, Result.OK, (2, -654)), {"R_TareAxis": 2, "R_TareRaw": -654}),
    (Reply(Opcode.GET_FULL_SCALE, 6, Result.OK, (0, 5000)), {"R_FullScale": 500.0}),
    (Reply(Opcode.GET_SERIAL, 7, Result.OK, (1, 77)), {"R_SerialPart": 1, "R_SerialAscii": 77}),
    (Reply(Opcode.GET_FIRMWARE, 8, Result.OK, (1, 2, 3, 4)), {"R_FwBuild": 3, "R_WireVersion": 4}),
]


@pytest.fixture(scope="module")
def dbc():
    path = Path(drivers.protocol.__file__).with_name("nrs.dbc")
    return cantools.database.load_file(path, strict=True)


def decoded(dbc, frame):
    return dbc.decode_message(frame.id, frame.data, decode_choices=False)


@pytest.mark.parametrize(("command", "signals"), COMMANDS)
def test_a_command_round_trips_and_cantools_agrees(dbc, command, signals):
    frame = encode_command(IDS, command)
    assert decode_command(frame.data) == command
    expected = {"C_Opcode": command.opcode, "C_Seq": command.seq} | signals
    assert decoded(dbc, frame) == pytest.approx(expected)


@pytest.mark.parametrize(("reply", "signals"), REPLIES)
def test_a_reply_round_trips_and_cantools_agrees(dbc, reply, signals):
    frame = encode_reply(IDS, reply)
    assert decode_reply(frame.data) == reply
    expected = {"R_Opcode": reply.opcode, "R_Seq": reply.seq, "R_Result": 0} | signals
    assert expected.items() <= decoded(dbc, frame).items()


@given(st.integers(0, 0xFFFF), st.integers(0, 255), st.integers(0, 255), st.integers(0, 2**32 - 1))
def test_cantools_reads_the_same_status(dbc, bits, half_degrees, dropped, count):
    status = Status(StatusBit(bits), half_degrees / 2 - 40, dropped, count)
    frame = encode_status(IDS, status)
    assert decode_status(frame.data) == status
    read = decoded(dbc, frame)
    assert (read["Temperature"], read["TxDropped"], read["SampleCount"]) == (
        status.temperature,
        dropped,
        count,
    )
    names = [
        signal.name
        for signal in dbc.get_message_by_name("NRS1_STATUS").signals
        if signal.length == 1
    ]
    assert [read[name] for name in names] == [bits >> bit & 1 for bit in range(16)]


@pytest.mark.parametrize("code", EmergencyCode)
def test_cantools_reads_the_same_emergency(dbc, code):
    event = Emergency(code, 1, 258, 5, 99)
    frame = encode_emergency(IDS, event)
    assert decode_emergency(frame.data) == event
    assert decoded(dbc, frame) == {
        "E_Code": code, "E_Register": 1, "E_Vendor": 258, "E_Axis": 5, "E_Counter": 99,
    }  # fmt: skip


@pytest.mark.parametrize("state", NodeState)
def test_a_heartbeat_round_trips_and_cantools_agrees(dbc, state):
    frame = encode_heartbeat(IDS, state)
    assert decode_heartbeat(frame.data) is state
    assert decoded(dbc, frame) == {"NodeState": state}


@given(st.binary(max_size=12))
def test_garbage_raises_protocol_error_or_nothing(octets):
    for decode in (decode_command, decode_reply, decode_status, decode_heartbeat, decode_emergency):
        with suppress(ProtocolError):
            decode(octets)


def test_an_argument_that_does_not_fit_is_the_callers_error():
    with pytest.raises(ValueError, match="does not fit"):
        encode_command(IDS, Command(Opcode.SET_PERIOD, 1, (256,)))
