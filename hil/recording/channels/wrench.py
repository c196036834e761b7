"""/wrench: what the sensor driver told the controller in one period."""

import struct
from itertools import chain

from drivers.interfaces import Freshness, WrenchReading
from hil.recording.channels.schema import (
    WRENCH_AXES,
    Fields,
    array,
    axes,
    boolean,
    integer,
    message,
    named,
    rows,
    text,
)

_HEAD = struct.Struct("<qq??")  # counter, age, fresh, tared

SCHEMA = message(
    "wrench",
    counter=integer("unwrapped count of the newest sample"),
    age=integer("age of the newest sample in arm time, ns"),
    freshness=text("ok: a new sample came; held: the last one stands in"),
    tared=boolean("whether the sensor was tared since its reset"),
    wrench=axes(WRENCH_AXES, "newest sample, N and N·m, sensor frame"),
    samples=array({"type": "array"}, "all new samples, oldest first, (n, 6)"),
)


def encode(reading: WrenchReading) -> bytes:
    wrench, samples, counter, age, freshness, tared = reading
    values = 6 + 6 * len(samples)
    return _HEAD.pack(counter, age, freshness is Freshness.OK, tared) + struct.pack(
        f"<{values}d", *wrench, *chain.from_iterable(samples)
    )


def fields(payload: bytes) -> Fields:
    counter, age, fresh, tared = _HEAD.unpack_from(payload)
    count = (len(payload) - _HEAD.size) // 8
    values = struct.unpack_from(f"<{count}d", payload, _HEAD.size)
    return {
        "counter": counter,
        "age": age,
        "freshness": (Freshness.OK if fresh else Freshness.HELD).value,
        "tared": tared,
        "wrench": named(WRENCH_AXES, values[:6]),
        "samples": rows(values[6:], 6),
    }
