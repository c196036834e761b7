"""/ctrl: what the controller saw and asked for in one period."""

import struct

from drivers.interfaces import Vector6
from hil.recording.channels.schema import (
    AXES6,
    STAGE_AXES,
    WRENCH_AXES,
    Fields,
    axes,
    integer,
    message,
    named,
    text,
)

_NUMBERS = struct.Struct("<i16d")  # k, set-point 6, wrench 6, stage 4

SCHEMA = message(
    "ctrl",
    phase=text("phase of the task"),
    k=integer("index of the skill's action in the episode, -1 outside one"),
    setpoint=axes(AXES6, "TCP set-point in base frame, m and rotation vector in rad"),
    wrench=axes(WRENCH_AXES, "mean wrench of the period in task frame, N, N·m"),
    stage=axes(STAGE_AXES, "TCP as the arm reports it, in task frame, m, rad"),
)


def encode(
    phase: str,
    k: int,
    setpoint: Vector6,
    wrench: Vector6,
    stage: tuple[float, float, float, float],
) -> bytes:
    return _NUMBERS.pack(k, *setpoint, *wrench, *stage) + phase.encode()


def fields(payload: bytes) -> Fields:
    k, *numbers = _NUMBERS.unpack_from(payload)
    return {
        "phase": payload[_NUMBERS.size :].decode(),
        "k": k,
        "setpoint": named(AXES6, numbers[0:6]),
        "wrench": named(WRENCH_AXES, numbers[6:12]),
        "stage": named(STAGE_AXES, numbers[12:16]),
    }
