"""Packages of the primary and secondary interfaces: framing, and the messages beside the state.

Big-endian throughout. A package is `int32 size, uint8 type, body`, its size counting all of it; a
robot message goes on with `uint64 timestamp, int8 source, int8 message type` (UR's client interface
manual, "Messages sent to primary and secondary clients").
"""

import struct
from enum import IntEnum
from typing import Final, NamedTuple

from drivers.protocol.errors import WireError

HEADER: Final = struct.Struct(">iB")

MAX_PACKAGE: Final = 1 << 16
"""Robot states stay below 2000 bytes; texts and lists of variables may be longer."""


class PackageType(IntEnum):
    ROBOT_STATE = 16
    ROBOT_MESSAGE = 20
    PROGRAM_STATE = 25


class Package(NamedTuple):
    """type: a PackageType, or a number that the manual keeps to itself."""

    type: int
    body: bytes


def encode(type: int, body: bytes) -> bytes:
    """The bytes of one package; ValueError above MAX_PACKAGE."""
    size = HEADER.size + len(body)
    if size > MAX_PACKAGE:
        raise ValueError(f"primary package of {size} bytes, allowed are {MAX_PACKAGE}")
    return HEADER.pack(size, type) + body


class Cutter:
    """Cuts a byte stream into packages; what it keeps is never more than one partial package."""

    __slots__ = ("_rest",)

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[Package]:
        """The packages that `data` completes; WireError when the stream cannot be cut."""
        stream, at, packages = self._rest + data, 0, []
        while len(stream) - at >= HEADER.size:
            size, kind = HEADER.unpack_from(stream, at)
            if not HEADER.size <= size <= MAX_PACKAGE:
                raise WireError(f"primary package of {size} bytes, allowed are 5..{MAX_PACKAGE}")
            if len(stream) - at < size:
                break
            packages.append(Package(kind, stream[at + HEADER.size : at + size]))
            at += size
        self._rest = stream[at:]
        return packages
