"""The writer's process: packed records in at stdin, one MCAP file out, its digest at stdout.

Started by the recorder as `python -m hil.recording.writer FD`, FD being the open part file.
Its work (JSON, compression) happens beside the control loop, not in it.
"""

import os
import pickle
import signal
import sys
from collections.abc import Iterator
from contextlib import suppress
from typing import BinaryIO

import orjson

from hil.recording.channel import Record
from hil.recording.codec import decoders
from hil.recording.identity import Identity
from hil.recording.mcap_file import McapFile
from hil.recording.ordering import Ordering
from hil.recording.pipe import Chunk, Report


def write(source: BinaryIO, target: BinaryIO) -> str:
    """Every chunk of `source` into `target`; the digest, "" when the recorder died before the end.

    A recording cut off so is complete up to the last chunk that came.
    """
    identity: Identity = pickle.load(source)
    decode = decoders(identity.recipes_in, identity.recipes_out)
    file, ordering = McapFile(target, identity), Ordering()
    complete = False
    for records, settled, complete in _chunks(source):  # noqa: B007  # the last one's word counts
        for t, channel, payload in records:
            ordering.add(Record(t, channel, orjson.dumps(decode[channel](payload))))
        for record in ordering.before(settled):
            file.write(record)
    for record in ordering.rest():
        file.write(record)
    digest = file.finish()
    return digest if complete else ""


def _chunks(source: BinaryIO) -> Iterator[Chunk]:
    """Chunks until the last one, or until the recorder is gone, perhaps in mid-chunk."""
    while True:
        try:
            chunk: Chunk = pickle.load(source)
        except (EOFError, pickle.UnpicklingError):
            return
        yield chunk
        if chunk.last:
            return


def main() -> None:
    # Ctrl-C is for the run; this process ends when the run's end of the pipe closes.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with os.fdopen(int(sys.argv[1]), "wb") as target:
            report = Report(write(sys.stdin.buffer, target), "")
    except OSError as error:
        report = Report("", error.strerror or str(error))
    with suppress(BrokenPipeError):  # the recorder was killed and nobody listens
        os.write(sys.stdout.fileno(), orjson.dumps(report._asdict()))


if __name__ == "__main__":
    main()
