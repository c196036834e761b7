"""/can/raw: the CAN frames of one control period, with the time each was on the bus."""

import struct
from collections.abc import Iterable

from drivers.protocol.frame import CanFrame
from hil.recording.channels.schema import Fields, array, message

_HEAD = struct.Struct("<qHBB")  # t, id, fd, length
_pack = _HEAD.pack

SCHEMA = message(
    "can/raw",
    frames=array({"type": "array"}, "[bench time ns, identifier hex, CAN FD 0/1, payload hex]"),
)


def encode(frames: Iterable[tuple[int, CanFrame]]) -> bytes:
    """(bench time ns, frame) pairs in bus order."""
    return b"".join([_pack(t, id, fd, len(payload)) + payload for t, (id, payload, fd) in frames])


def fields(payload: bytes) -> Fields:
    frames: list[object] = []
    at = 0
    while at < len(payload):
        t, id, fd, length = _HEAD.unpack_from(payload, at)
        at += _HEAD.size
        frames.append([t, f"{id:03X}", fd, payload[at : at + length].hex()])
        at += length
    return {"frames": frames}
