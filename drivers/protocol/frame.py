"""A CAN frame as both sides see it, whatever bus carries it."""

from typing import NamedTuple


class CanFrame(NamedTuple):
    """id: 11-bit identifier. data: payload. fd: CAN FD frame with bit-rate switch."""

    id: int
    data: bytes
    fd: bool = False
