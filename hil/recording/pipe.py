"""What recorder and writer say to each other: an Identity, then chunks; a report comes back."""

from typing import NamedTuple

from hil.recording.channel import Channel


class Chunk(NamedTuple):
    """Records in arrival order; settled: no record earlier than this will follow, ns."""

    records: list[tuple[int, Channel, bytes]]
    settled: int
    last: bool


class Report(NamedTuple):
    """What became of the file: its digest, or why there is none."""

    digest: str
    error: str
