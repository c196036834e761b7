"""Payloads of RTDE's set-up packages: versions, recipes, acceptance, text messages.

Protocol 2 adds a frequency to SETUP_OUTPUTS requests and a recipe id to their replies.
"""

import struct
from collections.abc import Sequence
from enum import IntEnum
from typing import Final, NamedTuple

from drivers.protocol.errors import WireError

_UINT16: Final = struct.Struct(">H")
_FREQUENCY: Final = struct.Struct(">d")
_VERSION: Final = struct.Struct(">4I")


class ControllerVersion(NamedTuple):
    """URControl's version; major 3 is CB3, 5 e-Series, 10 PolyScope X."""

    major: int
    minor: int
    bugfix: int
    build: int

    def __str__(self) -> str:
        return ".".join(map(str, self))


class TextLevel(IntEnum):
    """Severity of a text message."""

    EXCEPTION = 0
    ERROR = 1
    WARNING = 2
    INFO = 3


class TextMessage(NamedTuple):
    """What controller or client wants a person to read."""

    message: str
    source: str
    level: int


def encode_protocol_version(version: int) -> bytes:
    return _UINT16.pack(version)


def decode_protocol_version(payload: bytes) -> int:
    version: int = _unpack(_UINT16, payload, "protocol version")[0]
    return version


def encode_controller_version(version: ControllerVersion) -> bytes:
    return _VERSION.pack(*version)


def decode_controller_version(payload: bytes) -> ControllerVersion:
    return ControllerVersion(*_unpack(_VERSION, payload, "controller version"))


def encode_accepted(accepted: bool) -> bytes:
    return b"\x01" if accepted else b"\x00"


def decode_accepted(payload: bytes) -> bool:
    if len(payload) != 1:
        raise WireError(f"RTDE acceptance of {len(payload)} bytes, allowed is 1")
    return payload != b"\x00"


def encode_names(names: Sequence[str], frequency: float | None = None) -> bytes:
    """A recipe request; frequency in Hz for SETUP_OUTPUTS of protocol 2, else None."""
    head = b"" if frequency is None else _FREQUENCY.pack(frequency)
    return head + ",".join(names).encode("ascii")


def decode_names(payload: bytes) -> tuple[str, ...]:
    """The names of a recipe request without frequency; one trailing comma is forgiven (ur_rtde)."""
    names = _ascii(payload).split(",")
    if names[-1] == "":
        names.pop()
    return tuple(names)


def decode_names_with_frequency(payload: bytes) -> tuple[tuple[str, ...], float]:
    """The names and the frequency, Hz, of a protocol 2 SETUP_OUTPUTS request."""
    frequency: float = _unpack(_FREQUENCY, payload[: _FREQUENCY.size], "frequency")[0]
    return decode_names(payload[_FREQUENCY.size :]), frequency


def encode_types(types: Sequence[str], recipe_id: int | None = None) -> bytes:
    """A recipe reply; the id is absent in protocol 1 replies to SETUP_OUTPUTS."""
    head = b"" if recipe_id is None else bytes((recipe_id,))
    return head + ",".join(types).encode("ascii")


def decode_types(payload: bytes) -> tuple[str, ...]:
    """The types of a recipe reply without id: FieldType names, NOT_FOUND or IN_USE."""
    return tuple(_ascii(payload).split(","))


def decode_types_with_id(payload: bytes) -> tuple[tuple[str, ...], int]:
    """The types and the recipe id; id 0 is a refused recipe."""
    if not payload:
        raise WireError("RTDE recipe reply without a recipe id")
    return decode_types(payload[1:]), payload[0]


def encode_text(text: TextMessage) -> bytes:
    """A text message: both ways in protocol 2, from the controller in protocol 1."""
    return b"".join((_short(text.message), _short(text.source), bytes((text.level,))))


def decode_text(payload: bytes) -> TextMessage:
    message, rest = _cut_short(payload)
    source, rest = _cut_short(rest)
    if len(rest) != 1:
        raise WireError(f"RTDE text message with {len(rest)} bytes for its level, allowed is 1")
    return TextMessage(message, source, rest[0])


def encode_text_v1(level: int, message: str) -> bytes:
    """A client's text message in protocol 1: the level, then text to the end."""
    return bytes((level,)) + message.encode("utf-8")


def decode_text_v1(payload: bytes) -> TextMessage:
    """A client's text message in protocol 1, which names no source."""
    if not payload:
        raise WireError("RTDE text message without a level")
    return TextMessage(payload[1:].decode("utf-8", "replace"), "", payload[0])


def _unpack(layout: struct.Struct, payload: bytes, what: str) -> tuple[int, ...]:
    if len(payload) != layout.size:
        raise WireError(f"RTDE {what} of {len(payload)} bytes, allowed are {layout.size}")
    return layout.unpack(payload)


def _ascii(payload: bytes) -> str:
    try:
        return payload.decode("ascii")
    except UnicodeDecodeError:
        raise WireError("RTDE names and types are ASCII, found another byte") from None


def _short(text: str) -> bytes:
    raw = text.encode("utf-8")[:255]
    return bytes((len(raw),)) + raw


def _cut_short(payload: bytes) -> tuple[str, bytes]:
    if not payload or len(payload) <= payload[0]:
        raise WireError("RTDE text message is shorter than it says")
    end = 1 + payload[0]
    return payload[1:end].decode("utf-8", "replace"), payload[end:]
