"""The recorder: a list append in the control loop, a process that writes beside it."""

import fcntl
import os
import pickle
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Self

import orjson

from hil.recording.channel import Channel
from hil.recording.codec import decoders
from hil.recording.errors import RecordingError
from hil.recording.folder import finish, open_part
from hil.recording.identity import Identity
from hil.recording.pipe import Chunk, Report

CHUNK = 512
"""Records sent at once, about half a second: large enough that pickling costs 0.2 us a record."""

PIPE = 2**20
"""Bytes the pipe may hold, so that a busy writer does not hold up the loop (64 kB would)."""


class Recorder:
    """Records of one run, put in from one thread in any order of time.

    Each channel has one source that keeps its own order. `settle(t)` promises that nothing earlier
    than t follows, which lets the writer write; without it everything is kept until `close`.
    """

    def __init__(self, folder: Path, identity: Identity, *, overwrite: bool = False) -> None:
        decoders(identity.recipes_in, identity.recipes_out)  # a bad recipe shows here, not there
        self._folder, self._identity, self._overwrite = folder, identity, overwrite
        self._pending: list[tuple[int, Channel, bytes]] = []
        self._settled = -1
        self._writer: subprocess.Popen[bytes] | None = None
        self._failed = ""

    def open(self) -> None:
        """Make the folder and start the writer; RecordingError when it cannot be written to."""
        part = open_part(self._folder, self._overwrite)
        try:
            self._writer = _start(part)
        finally:
            os.close(part)
        self._send(self._identity)

    def put(self, channel: Channel, t: int, payload: bytes) -> None:
        """Record one payload, made by the channel's `encode`, at bench time t, ns.

        RecordingError, from then on at every call, once the writer could not write.
        """
        if self._failed:
            raise RecordingError(self._failed)
        if t < self._settled:
            raise ValueError(f"{channel.topic} at {t} ns, but {self._settled} ns was settled")
        self._pending.append((t, channel, payload))
        if len(self._pending) >= CHUNK:
            self._flush(last=False)

    def settle(self, t: int) -> None:
        """Promise that no record earlier than t, ns, follows."""
        self._settled = t

    def close(self) -> str:
        """Finish the file; its SHA-256. RecordingError when it could not be written."""
        if self._failed:
            raise RecordingError(self._failed)
        self._flush(last=True)
        report = self._join()
        if not report.digest:
            raise RecordingError(f"{self._folder}: recording failed: {report.error}")
        finish(self._folder)
        return report.digest

    def abandon(self) -> None:
        """Leave what there is as `run.mcap.part`, readable as far as it goes."""
        if self._writer is None:
            return
        with suppress(RecordingError):  # what led here matters more
            self._flush(last=False)
            self._join()

    def __enter__(self) -> Self:
        self.open()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.abandon()

    def _flush(self, *, last: bool) -> None:
        pending, self._pending = self._pending, []
        self._send(Chunk(pending, self._settled, last))

    def _send(self, item: Identity | Chunk) -> None:
        pipe = self._running().stdin
        assert pipe is not None
        try:
            pipe.write(pickle.dumps(item, pickle.HIGHEST_PROTOCOL))
            pipe.flush()
        except BrokenPipeError:
            self._failed = f"{self._folder}: recording failed: {self._join().error}"
            raise RecordingError(self._failed) from None

    def _join(self) -> Report:
        """Close the pipe, wait for the writer and take its report."""
        writer, self._writer = self._running(), None
        assert writer.stdin is not None
        assert writer.stdout is not None
        with suppress(BrokenPipeError):
            writer.stdin.close()
        with writer.stdout:
            said = writer.stdout.read()
        status = writer.wait()
        return Report(**orjson.loads(said)) if said else Report("", f"writer ended with {status}")

    def _running(self) -> "subprocess.Popen[bytes]":
        if self._writer is None:
            raise ValueError("the recorder is not open")
        return self._writer


def _start(part: int) -> "subprocess.Popen[bytes]":
    """The writer on an open part file, with a pipe to it."""
    writer = subprocess.Popen(
        [sys.executable, "-m", "hil.recording.writer", str(part)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        pass_fds=(part,),
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
        process_group=0,  # a terminal's Ctrl-C is not for the writer
    )
    assert writer.stdin is not None
    fcntl.fcntl(writer.stdin, fcntl.F_SETPIPE_SZ, PIPE)
    return writer
