"""What a bad link does to RTDE packages: pure functions of the package and of dice."""

import struct
from typing import Final

import numpy as np

from drivers.protocol.rtde import PackageType, encode
from drivers.protocol.rtde_setup import TextLevel, TextMessage, encode_protocol_version, encode_text

_HEADER: Final = struct.Struct(">HB")
_UNKNOWN: Final = 99
"""A protocol version and a package type that RTDE does not have."""


class Cutter:
    """Cuts a stream into whole packages, header included; what is no package passes as it is."""

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[bytes]:
        stream, packages = self._rest + data, []
        while len(stream) >= _HEADER.size:
            size, _ = _HEADER.unpack_from(stream)
            if size < _HEADER.size:
                packages.append(stream)
                stream = b""
            elif len(stream) < size:
                break
            else:
                packages.append(stream[:size])
                stream = stream[size:]
        self._rest = stream
        return packages


def is_data(package: bytes) -> bool:
    return len(package) >= _HEADER.size and package[2] == PackageType.DATA


def bent(package: bytes, field: str, bits: int, rng: np.random.Generator) -> bytes:
    """With a length below any package's, a type that no version has, or so many bits flipped."""
    if field == "length":
        return b"\x00\x00" + package[2:]
    if field == "type":
        return package[:2] + bytes((_UNKNOWN,)) + package[3:]
    octets = bytearray(package)
    for bit in rng.integers(8 * _HEADER.size, 8 * len(octets), bits).tolist():
        octets[bit // 8] ^= 1 << bit % 8
    return bytes(octets)


def refused(package: bytes, what: str) -> bytes:
    """A set-up request that the controller will refuse, since it asks for what is not there."""
    kind, payload = package[2], package[_HEADER.size :]
    if what == "version" and kind == PackageType.REQUEST_PROTOCOL_VERSION:
        return encode(kind, encode_protocol_version(_UNKNOWN))
    if what == "output" and kind == PackageType.SETUP_OUTPUTS:
        return encode(
            kind, payload.replace(b"actual_q,", b"actual_Q,").replace(b"timestamp", b"timestomp")
        )
    if what == "input" and kind == PackageType.SETUP_INPUTS:
        first = payload.split(b",", 1)[0]
        return encode(kind, payload.replace(first, first[:-1] + b"_", 1))
    return package


def in_use() -> bytes:
    """What a client is told whose inputs another one has taken."""
    text = TextMessage("RTDE inputs are in use by another client", "RTDE", TextLevel.ERROR)
    return encode(PackageType.TEXT_MESSAGE, encode_text(text))
