"""Codec of a wrench sample: a FORCE and TORQUE pair on classic CAN, one WRENCH_FD on CAN FD."""

import struct
from collections.abc import Sequence
from typing import Final, NamedTuple, TypeAlias

from drivers.protocol.crc8 import crc8
from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import (
    COUNT_LIMIT,
    FD_COUNT_LIMIT,
    FD_FORCE_LSB,
    FD_TORQUE_LSB,
    FORCE_LSB,
    TORQUE_LSB,
    Identifiers,
    ProtocolError,
    expect_length,
)

Counts: TypeAlias = Sequence[int]

_MASK: Final = (COUNT_LIMIT << 1) - 1
_FD_MASK: Final = (FD_COUNT_LIMIT << 1) - 1
_FD_TAIL: Final = struct.Struct("<HHB")


class Sample(NamedTuple):
    """wrench: N and N·m, sensor frame. flags: bits of nrs_can. counter: modulo 256, FD 65536."""

    wrench: tuple[float, float, float, float, float, float]
    flags: int
    counter: int


def encode_pair(
    ids: Identifiers, counts: Counts, flags: int, counter: int
) -> tuple[CanFrame, CanFrame]:
    """FORCE and TORQUE frames of six counts; ValueError when one does not fit in 17 bits."""
    if min(counts) < -COUNT_LIMIT or max(counts) >= COUNT_LIMIT:
        raise ValueError(f"counts {list(counts)} do not fit in 17 bits: clip before encoding")
    fx, fy, fz, tx, ty, tz = counts
    tail = flags << 51 | (counter & 0xFF) << 56
    force = fx & _MASK | (fy & _MASK) << 17 | (fz & _MASK) << 34 | tail
    torque = tx & _MASK | (ty & _MASK) << 17 | (tz & _MASK) << 34 | tail
    return (
        CanFrame(ids.force, force.to_bytes(8, "little")),
        CanFrame(ids.torque, torque.to_bytes(8, "little")),
    )


def decode_pair(force: bytes, torque: bytes) -> Sample:
    """The sample in two payloads; ProtocolError when they are not halves of one sample."""
    if len(force) != 8 or len(torque) != 8:
        raise ProtocolError(f"FORCE and TORQUE: {len(force)} and {len(torque)} bytes, not 8")
    f = int.from_bytes(force, "little")
    t = int.from_bytes(torque, "little")
    if f >> 51 != t >> 51:
        raise ProtocolError(
            f"FORCE (counter {force[7]}, flags {f >> 51 & 0x1F:#x}) and TORQUE (counter "
            f"{torque[7]}, flags {t >> 51 & 0x1F:#x}) are not halves of one sample"
        )
    # (x ^ sign) - sign extends the sign of a 17-bit field without a branch.
    wrench = (
        ((f & _MASK ^ COUNT_LIMIT) - COUNT_LIMIT) * FORCE_LSB,
        ((f >> 17 & _MASK ^ COUNT_LIMIT) - COUNT_LIMIT) * FORCE_LSB,
        ((f >> 34 & _MASK ^ COUNT_LIMIT) - COUNT_LIMIT) * FORCE_LSB,
        ((t & _MASK ^ COUNT_LIMIT) - COUNT_LIMIT) * TORQUE_LSB,
        ((t >> 17 & _MASK ^ COUNT_LIMIT) - COUNT_LIMIT) * TORQUE_LSB,
        ((t >> 34 & _MASK ^ COUNT_LIMIT) - COUNT_LIMIT) * TORQUE_LSB,
    )
    return Sample(wrench, f >> 51 & 0x1F, f >> 56)


def encode_fd(
    ids: Identifiers, counts: Counts, flags: int, counter: int, microseconds: int
) -> CanFrame:
    """WRENCH_FD frame; counts in FD_FORCE_LSB and FD_TORQUE_LSB, ValueError beyond 24 bits."""
    if min(counts) < -FD_COUNT_LIMIT or max(counts) >= FD_COUNT_LIMIT:
        raise ValueError(f"counts {list(counts)} do not fit in 24 bits: clip before encoding")
    packed = sum((count & _FD_MASK) << 24 * axis for axis, count in enumerate(counts))
    body = packed.to_bytes(18, "little") + _FD_TAIL.pack(
        counter & 0xFFFF, microseconds & 0xFFFF, flags
    )
    return CanFrame(ids.wrench_fd, body + bytes((_fd_checksum(body, ids.wrench_fd),)), fd=True)


def decode_fd(ids: Identifiers, octets: bytes) -> Sample:
    """The sample in a WRENCH_FD payload; ProtocolError for a wrong length, checksum or flag."""
    expect_length(octets, 24, "WRENCH_FD")
    if octets[23] != _fd_checksum(octets[:23], ids.wrench_fd):
        raise ProtocolError(f"WRENCH_FD: checksum {octets[23]:#04x} does not match")
    counter, _, flags = _FD_TAIL.unpack_from(octets, 18)
    if flags > 0x1F:
        raise ProtocolError(f"WRENCH_FD: reserved flag in {flags:#04x}")
    packed = int.from_bytes(octets[:18], "little")
    counts = [
        ((packed >> 24 * axis & _FD_MASK) ^ FD_COUNT_LIMIT) - FD_COUNT_LIMIT for axis in range(6)
    ]
    fx, fy, fz = (count * FD_FORCE_LSB for count in counts[:3])
    tx, ty, tz = (count * FD_TORQUE_LSB for count in counts[3:])
    return Sample((fx, fy, fz, tx, ty, tz), flags, counter)


def _fd_checksum(body: bytes, identifier: int) -> int:
    """CRC over bytes 0 .. 22 and the identifier's low byte, so that a swapped id is caught too."""
    return crc8(body + bytes((identifier & 0xFF,)))
