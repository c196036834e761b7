"""Reading a recording back, whole or as far as it goes."""

import hashlib
import io
import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import zstandard
from mcap import records
from mcap.exceptions import InvalidMagic, McapError
from mcap.stream_reader import StreamReader

from hil.recording.errors import RecordingError
from hil.recording.folder import NAME, PART

DAMAGE = (
    McapError, ValueError, LookupError, OverflowError, MemoryError, EOFError, struct.error,
    zstandard.ZstdError,
)  # fmt: skip
"""What the MCAP parser raises on bent bytes: it trusts lengths and names that it reads."""


class Message(NamedTuple):
    """t: bench time, ns. sequence: index within the topic. payload: JSON."""

    t: int
    topic: str
    sequence: int
    payload: bytes


@dataclass(frozen=True, slots=True)
class Recording:
    """One run as it was written.

    digest: SHA-256 of the file. ending: "" for a whole recording, else how it was cut off.
    metadata: by record name. attachments: by file name. messages: in the file's order.
    """

    path: Path
    digest: str
    ending: str
    metadata: Mapping[str, Mapping[str, str]]
    attachments: Mapping[str, bytes]
    messages: tuple[Message, ...]


def load(path: Path) -> Recording:
    """The recording in a file, or in a run's folder; RecordingError when there is none."""
    file = locate(path)
    try:
        content = file.read_bytes()
    except OSError as error:
        raise RecordingError(f"{file}: cannot be read: {error.strerror}") from None
    if not content:
        raise RecordingError(f"{file}: is empty")
    found, damage = _records(file, content)
    return Recording(
        path=file,
        digest=hashlib.sha256(content).hexdigest(),
        ending=damage or ("the run did not finish" if file.name == PART else ""),
        metadata={r.name: r.metadata for r in found if isinstance(r, records.Metadata)},
        attachments={r.name: r.data for r in found if isinstance(r, records.Attachment)},
        messages=tuple(_messages(found)),
    )


def locate(path: Path) -> Path:
    """The recording meant by a path: the file itself, or the run or its rest in a folder."""
    if not path.is_dir():
        return path
    for name in (NAME, PART):
        if (path / name).is_file():
            return path / name
    raise RecordingError(f"{path}: holds neither {NAME} nor {PART}")


def _records(file: Path, content: bytes) -> tuple[list[records.McapRecord], str]:
    """All records up to the first that cannot be read, and what was wrong with that one."""
    found: list[records.McapRecord] = []
    # A stream reader, since a file cut short has no index; checksums tell damage from content.
    stream = StreamReader(io.BytesIO(content), validate_crcs=True)
    channels = set[int]()
    try:
        in_data = True  # what follows DataEnd repeats: an index, outside the checksums
        for record in stream.records:
            in_data = in_data and not isinstance(record, records.DataEnd)
            if isinstance(record, records.Channel):
                channels.add(record.id)
            if isinstance(record, records.Message) and record.channel_id not in channels:
                break  # its channel's record was bent
            if in_data:
                found.append(record)
        else:
            return found, ""
    except InvalidMagic:
        if not found:
            raise RecordingError(f"{file}: is not an MCAP recording") from None
    except DAMAGE:
        pass
    return found, "cut off or damaged; this is what can be read"


def _messages(found: list[records.McapRecord]) -> Iterator[Message]:
    topics = {r.id: r.topic for r in found if isinstance(r, records.Channel)}
    for record in found:
        if isinstance(record, records.Message):
            yield Message(record.log_time, topics[record.channel_id], record.sequence, record.data)
