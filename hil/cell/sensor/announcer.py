"""What the node says unasked: heartbeat and status ten times a second, and events as they come."""

from typing import Final, TypeAlias

from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import Identifiers
from drivers.protocol.nrs_status import (
    Emergency,
    EmergencyCode,
    NodeState,
    Status,
    StatusBit,
    encode_emergency,
    encode_heartbeat,
    encode_status,
)

Timed: TypeAlias = tuple[int, CanFrame]

PERIOD: Final = 100_000_000
TEMPERATURE: Final = 25.0
"""Degrees Celsius; the emulation has no thermal model beyond warm-up drift."""

ANY_OVERLOAD: Final = StatusBit(0x3F)
TORQUE_OVERLOAD: Final = StatusBit(0x38)


class Announcer:
    """Keeps the two schedules and remembers what was said last."""

    def __init__(self, identifiers: Identifiers) -> None:
        self._ids = identifiers
        self._due = 0
        self._bits = 0

    def boot(self, t: int) -> Timed:
        """The one heartbeat that says the node has restarted."""
        self._bits = 0
        return (t, encode_heartbeat(self._ids, NodeState.BOOT))

    def ready(self, t: int) -> None:
        """The node has booted: both schedules start at t."""
        self._due = t

    def until(self, t: int, state: NodeState, bits: int, sent: int) -> list[Timed]:
        """Everything that is due up to t, in order; bits are those of StatusBit."""
        frames = self._events(t, bits, sent) if bits != self._bits else []
        while self._due <= t:
            frames.append((self._due, encode_heartbeat(self._ids, state)))
            frames.append((self._due, self._status(bits, sent)))
            self._due += PERIOD
        return frames

    def _events(self, t: int, bits: int, sent: int) -> list[Timed]:
        before, self._bits = self._bits, bits
        frames = [(t, self._status(bits, sent))]
        code = _emergency(StatusBit(before), StatusBit(bits))
        if code is not None:
            overloaded = bits & ANY_OVERLOAD
            # The lowest set bit is the first axis beyond its range.
            axis = (overloaded & -overloaded).bit_length() - 1 if overloaded else 255
            event = Emergency(code, int(code is not EmergencyCode.ERROR_RESET), 0, axis, sent)
            frames.append((t, encode_emergency(self._ids, event)))
        return frames

    def _status(self, bits: int, sent: int) -> CanFrame:
        return encode_status(self._ids, Status(StatusBit(bits), TEMPERATURE, 0, sent))


def _emergency(before: StatusBit, now: StatusBit) -> EmergencyCode | None:
    """The event that turns one set of status bits into the other, if it is one."""
    alarm = ANY_OVERLOAD | StatusBit.GAUGE_FAULT
    new = now & ~before & alarm
    if new & StatusBit.GAUGE_FAULT:
        return EmergencyCode.HARDWARE_GAUGE
    if new & ANY_OVERLOAD:
        torque_only = not new & ANY_OVERLOAD & ~TORQUE_OVERLOAD
        return EmergencyCode.TORQUE_OVERLOAD if torque_only else EmergencyCode.FORCE_OVERLOAD
    if before & alarm and not now & alarm:
        return EmergencyCode.ERROR_RESET
    return None
