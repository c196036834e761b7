"""Records in order into an MCAP file whose bytes depend on their content alone."""

import hashlib
from typing import BinaryIO

import orjson
from mcap.writer import Writer

from hil.recording.channel import Channel, Record
from hil.recording.codec import SCHEMAS
from hil.recording.identity import Identity, versions

CHUNK = 256 * 1024
"""Bytes of JSON in one compressed chunk, about half a second: what a cut file loses at most."""


DIALECT = "https://json-schema.org/draft/2020-12/schema"


class DigestingStream:
    """A file that hashes what passes; MCAP is written front to back, so nothing is read again."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._hash = hashlib.sha256()
        self._written = 0

    def write(self, content: bytes) -> int:
        self._hash.update(content)
        self._written += len(content)
        return self._file.write(content)

    def tell(self) -> int:
        return self._written

    def flush(self) -> None:
        self._file.flush()

    @property
    def digest(self) -> str:
        return self._hash.hexdigest()


class McapFile:
    """One run's MCAP: identity first, so that a file cut short still says what it was."""

    def __init__(self, file: BinaryIO, identity: Identity) -> None:
        self._stream = DigestingStream(file)
        self._writer = Writer(
            self._stream,  # type: ignore[arg-type]  # it asks for a file, it needs write and tell
            chunk_size=CHUNK,
            enable_data_crcs=True,
        )
        self._writer.start(profile="", library="hil-testbed")
        self._writer.add_metadata("run", identity.metadata())
        self._writer.add_metadata("versions", versions())
        self._attach("rig.yaml", "application/yaml", identity.rig)
        if identity.dbc:
            self._attach("nrs.dbc", "text/plain", identity.dbc)
        self._ids = {channel: self._register(channel) for channel in Channel}
        self._counts = dict.fromkeys(Channel, 0)

    def write(self, record: Record) -> None:
        """One record whose payload is JSON."""
        t, channel, message = record
        sequence = self._counts[channel]
        self._counts[channel] = sequence + 1
        self._writer.add_message(self._ids[channel], t, message, t, sequence)

    def finish(self) -> str:
        """Write the index; the file's SHA-256."""
        self._writer.finish()  # type: ignore[no-untyped-call]
        self._stream.flush()
        return self._stream.digest

    def _attach(self, name: str, media_type: str, content: bytes) -> None:
        self._writer.add_attachment(0, 0, name, media_type, content)

    def _register(self, channel: Channel) -> int:
        name = channel.topic.removeprefix("/")
        schema = orjson.dumps({"$schema": DIALECT, **SCHEMAS[channel]})
        return self._writer.register_channel(
            channel.topic, "json", self._writer.register_schema(name, "jsonschema", schema)
        )
