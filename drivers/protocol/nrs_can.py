"""CAN identifiers, flags and scales of the force/torque sensor; its layout is in nrs.dbc.

The vendor publishes no CAN interface for the NRS-6050: this wire format is the project's own.
Identifiers follow CANopen's predefined set so that bus tools label them, but it is not CANopen.
"""

from typing import Final, NamedTuple

from drivers.errors import ProtocolError

__all__ = ["ProtocolError", "expect_length"]

FORCE_LSB: Final = 0.015
TORQUE_LSB: Final = 0.312e-3
COUNT_LIMIT: Final = 1 << 16
"""Counts of the classic frames are s17: -COUNT_LIMIT .. COUNT_LIMIT - 1."""

FD_FORCE_LSB: Final = 0.001
FD_TORQUE_LSB: Final = 2e-6
FD_COUNT_LIMIT: Final = 1 << 23

# Flags of a sample, the same bits in FORCE, TORQUE and WRENCH_FD.
VALID: Final = 0x01
OVERLOAD: Final = 0x02
SATURATED: Final = 0x04
TARED: Final = 0x08
FAULT: Final = 0x10

WIRE_VERSION: Final = 1


class Identifiers(NamedTuple):
    """The 11-bit identifiers that one node sends (all but `command`) and obeys."""

    force: int
    torque: int
    wrench_fd: int
    status: int
    command: int
    reply: int
    heartbeat: int
    emergency: int

    @classmethod
    def of(cls, node: int) -> "Identifiers":
        """Identifiers of node 1 .. 15."""
        if not 1 <= node <= 15:
            raise ValueError(f"node id {node} is not in 1 .. 15")
        return cls(
            force=0x180 + node,
            torque=0x280 + node,
            wrench_fd=0x1A0 + node,
            status=0x380 + node,
            command=0x200 + node,
            reply=0x480 + node,
            heartbeat=0x700 + node,
            emergency=0x080 + node,
        )


def expect_length(octets: bytes, length: int, name: str) -> None:
    """Raise ProtocolError unless the payload of a `name` frame is `length` bytes long."""
    if len(octets) != length:
        raise ProtocolError(f"{name}: {len(octets)} bytes instead of {length}")
