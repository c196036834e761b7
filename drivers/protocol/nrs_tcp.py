"""Codec of the sensor's public TCP protocol (port 2001), as the vendor's demo clients speak it.

A message is `uint8 length, uint8 type, payload`, and its length counts itself. There is no counter,
no time, no status and no checksum: see docs/sensor.md for what is known of it and what assumed.
"""

import struct
from enum import IntEnum
from math import isfinite
from typing import Final, NamedTuple, TypeAlias

from drivers.protocol.errors import WireError

Wrench: TypeAlias = tuple[float, float, float, float, float, float]

PORT: Final = 2001
MAX_PERIOD: Final = 200
"""Milliseconds between messages, at most."""

_DATA: Final = struct.Struct(">BB6d")
_VALUES: Final = struct.Struct(">6d")
_HEADER: Final = 2


class Kind(IntEnum):
    """Message types; an acknowledgement carries the type of its command."""

    DATA = 0x06
    TRANSMIT = 0x07
    PERIOD = 0x08
    TARE = 0x15


class Message(NamedTuple):
    """kind: a Kind, or a number that no public client knows."""

    kind: int
    payload: bytes


def encode(kind: int, value: int) -> bytes:
    """A command with its argument, or an acknowledgement; ValueError for more than a byte."""
    return bytes((_HEADER + 1, kind, value))


def encode_wrench(wrench: Wrench) -> bytes:
    """One data message: N and N·m, sensor frame."""
    return _DATA.pack(_DATA.size, Kind.DATA, *wrench)


def decode_wrench(payload: bytes) -> Wrench:
    """The wrench of a data message; WireError for another length or a number that is not finite."""
    if len(payload) != _VALUES.size:
        raise WireError(f"NRS data of {len(payload)} bytes instead of {_VALUES.size}")
    wrench: Wrench = _VALUES.unpack(payload)
    if not all(map(isfinite, wrench)):
        raise WireError(f"NRS data that is not finite: {wrench}")
    return wrench


class Cutter:
    """Cuts a byte stream into messages; a length byte bounds what it keeps to 254 bytes."""

    __slots__ = ("_rest",)

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, octets: bytes) -> list[Message]:
        """The messages that these bytes complete; WireError for a length without a type."""
        stream = self._rest + octets if self._rest else octets
        start, messages = 0, []
        while start < len(stream):
            length = stream[start]
            if length < _HEADER:
                raise WireError(f"NRS message of length {length}, the least is {_HEADER}")
            if start + length > len(stream):
                break
            messages.append(Message(stream[start + 1], stream[start + _HEADER : start + length]))
            start += length
        self._rest = stream[start:]
        return messages
