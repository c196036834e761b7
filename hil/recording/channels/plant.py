"""/plant: stage and part as they truly are at the period's end."""

import struct
from typing import TYPE_CHECKING

from hil.recording.channels.schema import (
    STAGE_AXES,
    Fields,
    axes,
    message,
    named,
    number,
    text,
)

if TYPE_CHECKING:  # the writer's process decodes without numpy
    from hil.cell.plant.interface import PlantStep

_NUMBERS = struct.Struct("<16d")  # stage 4, velocity 4, tip 3, theta, depth, grip 3

SCHEMA = message(
    "plant",
    stage=axes(STAGE_AXES, "TCP in task frame, m, rad"),
    velocity=axes(STAGE_AXES, "TCP velocity in task frame, m/s, rad/s"),
    part={"type": ["string", "null"], "description": "the gripped part, null when jaws are empty"},
    tip=axes(("x", "y", "z"), "middle of the part's tip in task frame, m"),
    theta=number("rotation of the part's tip about z, rad"),
    depth=number("tip below the connector's face, m"),
    grip=axes(("x", "y", "theta"), "part in jaws, m, rad"),
    contact=text("free, face, slot or bottom"),
)


def encode(step: "PlantStep") -> bytes:
    part = step.part
    numbers = _NUMBERS.pack(
        *step.stage, *step.velocity, *part.tip, part.theta, part.depth, *part.grip
    )
    return b"%b%b\0%b" % (numbers, part.contact.value.encode(), (part.name or "").encode())


def fields(payload: bytes) -> Fields:
    numbers = _NUMBERS.unpack_from(payload)
    contact, _, name = payload[_NUMBERS.size :].decode().partition("\0")
    return {
        "stage": named(STAGE_AXES, numbers[0:4]),
        "velocity": named(STAGE_AXES, numbers[4:8]),
        "part": name or None,
        "tip": named(("x", "y", "z"), numbers[8:11]),
        "theta": numbers[11],
        "depth": numbers[12],
        "grip": named(("x", "y", "theta"), numbers[13:16]),
        "contact": contact,
    }
