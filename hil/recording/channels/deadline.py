"""/deadline: which period it was and how many commands came too late in bench time so far."""

import struct

from hil.recording.channels.schema import Fields, integer, message

_NUMBERS = struct.Struct("<qq")

SCHEMA = message(
    "deadline",
    period=integer("index of the control period"),
    misses=integer("commands that came after their period's end, bench time, since the start"),
)


def encode(period: int, misses: int) -> bytes:
    return _NUMBERS.pack(period, misses)


def fields(payload: bytes) -> Fields:
    period, misses = _NUMBERS.unpack(payload)
    return {"period": period, "misses": misses}
