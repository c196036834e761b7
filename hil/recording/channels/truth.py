"""/wrench/true: the plant's wrench at every millisecond of the period, before the sensor."""

import struct
from typing import TYPE_CHECKING

from hil.recording.channels.schema import Fields, array, message, rows

if TYPE_CHECKING:  # the writer's process decodes without numpy
    from hil.cell.plant.interface import Array

SCHEMA = message(
    "wrench/true",
    wrenches=array(
        {"type": "array"}, "(n, 6) at 1 ms, 2 ms, ... of the period; N, N·m, sensor frame"
    ),
)


def encode(wrenches: "Array") -> bytes:
    """The array's own bytes; wrenches is float64, C order, (n, 6)."""
    return wrenches.tobytes()


def fields(payload: bytes) -> Fields:
    values = struct.unpack(f"={len(payload) // 8}d", payload)
    return {"wrenches": rows(values, 6)}
