"""What an error frame of the kernel's CAN drivers says (linux/can/error.h); no bus in here."""

from enum import IntFlag, StrEnum
from typing import Final, NamedTuple


class BusState(StrEnum):
    """Fault confinement of a CAN controller (ISO 11898-1, 12.1.4), as `ip -details link` says it.

    An error-passive controller may no longer shout, one that is off the bus neither sends nor
    hears.
    """

    ACTIVE = "error-active"
    WARNING = "error-warning"
    PASSIVE = "error-passive"
    OFF = "bus-off"


class ErrorClass(IntFlag):
    """The identifier of an error frame."""

    CONTROLLER = 0x004
    NO_ACK = 0x020
    BUS_OFF = 0x040
    RESTARTED = 0x100


class ControllerStatus(IntFlag):
    """data[1] of an error frame of class CONTROLLER; each of receiver and transmitter."""

    OVERFLOW = 0x01 | 0x02
    WARNING = 0x04 | 0x08
    PASSIVE = 0x10 | 0x20
    ACTIVE = 0x40


_STATES: Final = (  # worst first: a frame may name both ends of the controller
    (ControllerStatus.PASSIVE, BusState.PASSIVE),
    (ControllerStatus.WARNING, BusState.WARNING),
    (ControllerStatus.ACTIVE, BusState.ACTIVE),
)
_STATUS: Final = 1


class ErrorFrame(NamedTuple):
    """state: the controller's new one, None where the frame tells none. text: for a person."""

    state: BusState | None
    text: str


def decode_error(kind: int, data: bytes) -> ErrorFrame:
    """Read an error frame's identifier and payload; never fails, since drivers differ in both."""
    status = data[_STATUS] if kind & ErrorClass.CONTROLLER and len(data) > _STATUS else 0
    state = _state(kind, status)
    notes = [] if state is None else [f"CAN controller is {state}"]
    if kind & ErrorClass.NO_ACK:
        notes.append("no other node acknowledges: check termination, bitrate and power")
    if status & ControllerStatus.OVERFLOW:
        notes.append("CAN controller lost frames: its buffer was full")
    return ErrorFrame(state, "; ".join(notes) or f"CAN error frame, class {kind:#x}")


def _state(kind: int, status: int) -> BusState | None:
    if kind & ErrorClass.BUS_OFF:
        return BusState.OFF
    if kind & ErrorClass.RESTARTED:
        return BusState.ACTIVE
    return next((state for bits, state in _STATES if status & bits), None)
