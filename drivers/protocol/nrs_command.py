"""Codec of CMD and REPLY: what a host may ask of the sensor node, and what it answers."""

import struct
from collections.abc import Mapping
from enum import IntEnum
from typing import Final, NamedTuple

from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import Identifiers, ProtocolError, expect_length


class Opcode(IntEnum):
    """0x07, 0x08 and 0x15 are the vendor's TCP opcodes, 0x01 and 0x16 .. 0x1C those of the iCub
    strain board, which shares the other three; 0x40 and 0x42 are this project's.
    """

    SET_FILTER = 0x01
    TRANSMIT = 0x07
    SET_PERIOD = 0x08
    SAVE = 0x09
    TARE = 0x15
    GET_TARE = 0x16
    GET_FULL_SCALE = 0x18
    GET_SERIAL = 0x1A
    GET_FIRMWARE = 0x1C
    RESET = 0x40
    CLEAR_FAULT = 0x42


class Result(IntEnum):
    """What a command came to."""

    OK = 0
    UNSUPPORTED = 1
    OUT_OF_RANGE = 2
    WRONG_STATE = 3
    BUSY = 4
    FAILED = 5


TARE_CLEAR: Final = 0
TARE_NEGATIVE_OF_CURRENT: Final = 1
RESET_MAGIC: Final = 0xB007

_NONE: Final = struct.Struct("<")
_BYTE: Final = struct.Struct("<B")
_WORD: Final = struct.Struct("<H")

ARGUMENTS: Final[Mapping[int, struct.Struct]] = {
    Opcode.SET_FILTER: _WORD,  # cut-off, 0.1 Hz
    Opcode.TRANSMIT: _BYTE,  # 0 or 1
    Opcode.SET_PERIOD: _BYTE,  # ms
    Opcode.SAVE: _NONE,
    Opcode.TARE: struct.Struct("<BH"),  # mode, samples
    Opcode.GET_TARE: _BYTE,  # axis
    Opcode.GET_FULL_SCALE: _BYTE,  # axis
    Opcode.GET_SERIAL: _BYTE,  # part 0 .. 3
    Opcode.GET_FIRMWARE: _NONE,
    Opcode.RESET: _WORD,  # magic
    Opcode.CLEAR_FAULT: _NONE,
}
"""Layout of CMD from byte 2 on."""

VALUES: Final[Mapping[int, struct.Struct]] = {
    Opcode.SET_FILTER: _WORD,  # cut-off applied, 0.1 Hz
    Opcode.TRANSMIT: _BYTE,
    Opcode.SET_PERIOD: _BYTE,
    Opcode.SAVE: _NONE,
    Opcode.TARE: _BYTE,  # counter of the first sample on the new zero
    Opcode.GET_TARE: struct.Struct("<Bi"),  # axis, counts
    Opcode.GET_FULL_SCALE: struct.Struct("<BH"),  # axis, 0.1 N or 0.1 N·m
    Opcode.GET_SERIAL: struct.Struct("<BI"),  # part, four ASCII characters
    Opcode.GET_FIRMWARE: struct.Struct("<BBHB"),  # major, minor, build, wire version
    Opcode.RESET: _NONE,
    Opcode.CLEAR_FAULT: _NONE,
}
"""Layout of an OK REPLY from byte 3 on."""


class Command(NamedTuple):
    """opcode: may be unknown. arguments: as ARGUMENTS lays them out, () for an unknown opcode."""

    opcode: int
    seq: int
    arguments: tuple[int, ...] = ()


class Reply(NamedTuple):
    """values: as VALUES lays them out, () unless result is OK."""

    opcode: int
    seq: int
    result: Result
    values: tuple[int, ...] = ()


def encode_command(ids: Identifiers, command: Command) -> CanFrame:
    """CMD frame; ValueError when an argument does not fit its field."""
    layout = ARGUMENTS.get(command.opcode, _NONE)
    octets = bytes((command.opcode, command.seq)) + _pack(layout, command.arguments)
    return CanFrame(ids.command, octets.ljust(8, b"\0"))


def decode_command(octets: bytes) -> Command:
    """CMD payload; raises ProtocolError for a wrong length. Unused bytes are ignored."""
    expect_length(octets, 8, "CMD")
    layout = ARGUMENTS.get(octets[0], _NONE)
    return Command(octets[0], octets[1], layout.unpack_from(octets, 2))


def encode_reply(ids: Identifiers, reply: Reply) -> CanFrame:
    """REPLY frame; ValueError when a value does not fit its field."""
    layout = VALUES.get(reply.opcode, _NONE) if reply.result is Result.OK else _NONE
    octets = bytes((reply.opcode, reply.seq, reply.result)) + _pack(layout, reply.values)
    return CanFrame(ids.reply, octets.ljust(8, b"\0"))


def decode_reply(octets: bytes) -> Reply:
    """REPLY payload; raises ProtocolError."""
    expect_length(octets, 8, "REPLY")
    try:
        result = Result(octets[2])
    except ValueError:
        raise ProtocolError(f"REPLY: unknown result {octets[2]}") from None
    layout = VALUES.get(octets[0], _NONE) if result is Result.OK else _NONE
    return Reply(octets[0], octets[1], result, layout.unpack_from(octets, 3))


def _pack(layout: struct.Struct, numbers: tuple[int, ...]) -> bytes:
    try:
        return layout.pack(*numbers)
    except struct.error as error:
        raise ValueError(f"{numbers} does not fit '{layout.format}': {error}") from None
