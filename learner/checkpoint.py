"""One file with everything a learner needs to go on as if there had been no break.

Layout: magic, SHA-256 of the rest, then MessagePack under zstandard. Arrays keep dtype and shape to
the bit. Written beside its place and renamed over it: a crash leaves the old file or the new one.
"""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Final

import msgpack  # type: ignore[import-untyped]  # without stubs
import numpy as np
import zstandard

from learner.errors import CheckpointError
from learner.interface import State

MAGIC: Final = b"HILLEARN1\n"
_ARRAY: Final = 1
_INTEGER: Final = 2


@dataclass(frozen=True, slots=True)
class Checkpoint:
    """learner: its name or import path. settings: as text, what it was built with. rig: name of the
    rig. seed: of the run. episodes: finished so far. versions: of what wrote it.
    """

    learner: str
    settings: Mapping[str, str]
    rig: str
    seed: int
    episodes: int
    versions: Mapping[str, str]
    state: State


def write(path: Path, checkpoint: Checkpoint) -> str:
    """Put it at `path`, all or nothing; the file's SHA-256. Raises CheckpointError."""
    content = encode(checkpoint)
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with beside.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        beside.replace(path)
    except OSError as error:
        beside.unlink(missing_ok=True)
        raise CheckpointError(f"{path}: cannot be written: {error.strerror}") from None
    return sha256(content).hexdigest()


def read(path: Path) -> Checkpoint:
    """The checkpoint at `path`; CheckpointError says in one line what is wrong with it."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise CheckpointError(f"{path}: cannot be read: {error.strerror}") from None
    try:
        return decode(content)
    except CheckpointError as error:
        raise CheckpointError(f"{path}: {error}") from None


def encode(checkpoint: Checkpoint) -> bytes:
    """The file's content; equal checkpoints give equal bytes."""
    fields = {name: getattr(checkpoint, name) for name in checkpoint.__dataclass_fields__}
    packed = msgpack.packb(_plain(fields), use_bin_type=True)
    body = zstandard.ZstdCompressor(level=3, write_content_size=True).compress(packed)
    return MAGIC + sha256(body).digest() + body


def decode(content: bytes) -> Checkpoint:
    """The checkpoint in a file's content; raises CheckpointError."""
    if not content.startswith(MAGIC):
        raise CheckpointError("not a learner's checkpoint")
    digest, body = content[len(MAGIC) :][:32], content[len(MAGIC) + 32 :]
    if sha256(body).digest() != digest:
        raise CheckpointError("damaged: its checksum does not match")
    fields = msgpack.unpackb(
        zstandard.ZstdDecompressor().decompress(body), ext_hook=_restored, raw=False
    )
    try:
        return Checkpoint(**fields)
    except TypeError as error:
        raise CheckpointError(f"of another version: {error}") from None


def _plain(value: object) -> object:
    """Mappings in the order of their keys; arrays and long integers as extension types."""
    if isinstance(value, Mapping):
        return {str(key): _plain(value[key]) for key in sorted(value)}
    if isinstance(value, np.ndarray):
        head = msgpack.packb([value.dtype.str, list(value.shape)])
        return msgpack.ExtType(_ARRAY, head + np.ascontiguousarray(value).tobytes())
    if isinstance(value, int) and not -(1 << 63) <= value < 1 << 63:
        return msgpack.ExtType(_INTEGER, str(value).encode())  # a bit generator's words
    if isinstance(value, str | int | float):
        return value
    raise CheckpointError(f"cannot keep a {type(value).__name__}: {value!r}")


def _restored(code: int, body: bytes) -> object:
    if code == _INTEGER:
        return int(body)
    if code != _ARRAY:
        raise CheckpointError(f"holds something unknown, of type {code}")
    unpacker = msgpack.Unpacker()
    unpacker.feed(body)
    dtype, shape = unpacker.unpack()
    return np.frombuffer(body[unpacker.tell() :], dtype).reshape(shape).copy()
