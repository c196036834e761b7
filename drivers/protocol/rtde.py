"""RTDE framing and data packages: bytes to packages, packages to values, no sockets.

All numbers are big-endian and unaligned (RTDE guide, "Field descriptions"). A package is
`uint16 size, uint8 type, payload`, and its size counts the three header bytes.
"""

import struct
from collections.abc import Callable, Sequence
from enum import Enum, IntEnum
from operator import itemgetter
from typing import Final, NamedTuple

from drivers.protocol.errors import WireError

_HEADER: Final = struct.Struct(">HB")

MAX_PACKAGE: Final = 4096
"""Above any legal package: a list of names may hold 2048 bytes, data packages stay below 2000."""


class PackageType(IntEnum):
    """Package types; each value is the ASCII code of the guide's letter."""

    TEXT_MESSAGE = ord("M")
    DATA = ord("U")
    REQUEST_PROTOCOL_VERSION = ord("V")
    GET_CONTROLLER_VERSION = ord("v")
    SETUP_OUTPUTS = ord("O")
    SETUP_INPUTS = ord("I")
    START = ord("S")
    PAUSE = ord("P")


class Package(NamedTuple):
    """type: a PackageType, or a number no version defines. payload: what follows the header."""

    type: int
    payload: bytes


def encode(type: int, payload: bytes = b"") -> bytes:
    """The bytes of one package; ValueError above MAX_PACKAGE."""
    size = _HEADER.size + len(payload)
    if size > MAX_PACKAGE:
        raise ValueError(f"RTDE package of {size} bytes, allowed are {MAX_PACKAGE}")
    return _HEADER.pack(size, type) + payload


class Cutter:
    """Cuts a byte stream into packages; what it keeps is never more than one partial package."""

    __slots__ = ("_limit", "_rest")

    def __init__(self, limit: int = MAX_PACKAGE) -> None:
        self._limit = limit
        self._rest = b""

    def feed(self, data: bytes) -> list[Package]:
        """The packages that `data` completes; WireError when the stream cannot be RTDE."""
        stream = self._rest + data if self._rest else data
        packages = []
        at, end = 0, len(stream)
        while end - at >= _HEADER.size:
            size, kind = _HEADER.unpack_from(stream, at)
            if not _HEADER.size <= size <= self._limit:
                raise WireError(f"RTDE package of {size} bytes, allowed are 3..{self._limit}")
            if end - at < size:
                break
            packages.append(Package(kind, stream[at + _HEADER.size : at + size]))
            at += size
        self._rest = stream[at:]
        return packages


class FieldType(Enum):
    """RTDE's field types as (struct code, count); names are those on the wire."""

    BOOL = ("?", 1)
    UINT8 = ("B", 1)
    UINT32 = ("I", 1)
    UINT64 = ("Q", 1)
    INT32 = ("i", 1)
    DOUBLE = ("d", 1)
    VECTOR3D = ("d", 3)
    VECTOR6D = ("d", 6)
    VECTOR6INT32 = ("i", 6)
    VECTOR6UINT32 = ("I", 6)

    @property
    def code(self) -> str:
        return self.value[0]

    @property
    def count(self) -> int:
        return self.value[1]


NOT_FOUND: Final = "NOT_FOUND"
"""Stands for a type when the controller does not know the name."""

IN_USE: Final = "IN_USE"
"""Stands for a type when another client owns the input."""


class Recipe:
    """Order and types of a data package's values; compiled once, used every period."""

    __slots__ = ("_counts", "_cut", "_scalar", "_struct", "names", "size", "types")

    def __init__(self, names: Sequence[str], types: Sequence[FieldType]) -> None:
        if len(names) != len(types) or not names:
            raise ValueError(f"a recipe needs one type a name, found {len(types)} for {len(names)}")
        self.names = tuple(names)
        self.types = tuple(types)
        self._struct = struct.Struct(">" + "".join(f"{t.count}{t.code}" for t in types))
        self._counts = tuple(t.count for t in types)
        self._scalar = max(self._counts) == 1
        self._cut = _cutting(self.types)
        self.size = self._struct.size

    def pack(self, values: Sequence[object]) -> bytes:
        """The body of a data package, recipe id excluded, from numbers and tuples or lists.

        Raises ValueError when a value does not fit.
        """
        flat = values if self._scalar else self._flatten(values)
        try:
            return self._struct.pack(*flat)
        except struct.error as error:
            raise ValueError(
                f"values do not fit the recipe {','.join(self.names)}: {error}"
            ) from None

    def unpack(self, body: bytes) -> tuple[object, ...]:
        """The values, vectors as tuples; WireError when the body has another size."""
        if len(body) != self.size:
            raise WireError(f"RTDE data of {len(body)} bytes, the recipe has {self.size}")
        return self._cut(self._struct.unpack(body))

    def _flatten(self, values: Sequence[object]) -> list[object]:
        if len(values) != len(self.types):
            raise ValueError(f"{len(values)} values for the {len(self.types)} of the recipe")
        flat: list[object] = []
        for count, value in zip(self._counts, values, strict=True):
            if count == 1:
                flat.append(value)
            elif isinstance(value, (tuple, list)) and len(value) == count:
                flat.extend(value)
            else:
                raise ValueError(f"a vector of {count} numbers is needed, found {value!r}")
        return flat


def _cutting(types: Sequence[FieldType]) -> Callable[[tuple[object, ...]], tuple[object, ...]]:
    """What turns struct's flat tuple into one entry a variable (itemgetter: 5x a Python loop)."""
    if all(field.count == 1 for field in types):
        return lambda flat: flat
    keys: list[int | slice] = []
    at = 0
    for field in types:
        keys.append(at if field.count == 1 else slice(at, at + field.count))
        at += field.count
    if len(keys) == 1:
        return lambda flat: (flat,)
    return itemgetter(*keys)
