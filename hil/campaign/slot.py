"""A place for one run at a time: the client's end of a warm worker process."""

import json
import os
import subprocess
import sys
from dataclasses import asdict, dataclass
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from time import monotonic
from typing import Self

from hil.campaign.errors import CampaignError
from hil.campaign.run import Outcome, Run, Verdict, decode_outcome, encode

GRACE = 60.0
"""Wall seconds a worker may take beyond a run's limit: its imports and its own death included."""

BOUNDED = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""One core a run: slots are how a campaign uses several."""


@dataclass(frozen=True, slots=True)
class Work:
    """What a worker gets ready for. limit: wall s of a run. prepare: see Plan."""

    function: str
    limit: float
    prepare: str = ""


class Slot:
    """Owns one worker process, started when first needed and again when it died."""

    def __init__(self, work: Work) -> None:
        self._work = work
        self._process: subprocess.Popen[bytes] | None = None
        self._pipe: Connection | None = None
        self._due = 0.0
        self._closed = False

    def submit(self, run: Run) -> None:
        """Begin a run; the slot must be idle."""
        try:
            self._worker().send_bytes(encode(run))
        except BrokenPipeError:  # it died while idle
            self._end()
            self._worker().send_bytes(encode(run))
        self._due = monotonic() + self._work.limit + GRACE

    def fileno(self) -> int:
        """Readable when the outcome is there, for `multiprocessing.connection.wait`."""
        return self._worker().fileno()

    def overdue(self) -> bool:
        return monotonic() > self._due

    def outcome(self) -> Outcome:
        """Wait for what became of the run; CampaignError when the slot was closed meanwhile."""
        pipe = self._worker()
        try:
            if pipe.poll(max(0.0, self._due - monotonic())):
                return decode_outcome(pipe.recv_bytes())
            lost = Outcome(Verdict.HANG, f"no answer within {GRACE:g} s beyond the limit")
        except (EOFError, ConnectionError):
            lost = Outcome(Verdict.CRASH, "the worker process died")
        if self._closed:
            raise CampaignError("the campaign was closed during a run")
        self._end()
        return lost

    def _worker(self) -> Connection:
        if self._pipe is None:
            self._pipe, theirs = Pipe()
            with theirs:
                self._process = _started(theirs, self._work)
            self._greeted(self._pipe)
        return self._pipe

    def _greeted(self, pipe: Connection) -> None:
        """Wait for the worker's first word, so that one that cannot start is no run's crash."""
        try:
            if not pipe.poll(GRACE):
                raise EOFError
            pipe.recv_bytes()
        except (EOFError, ConnectionError):
            self._end()
            raise CampaignError("a worker process could not be started; see above") from None

    def _end(self) -> None:
        if self._process is not None:
            self._process.kill()  # its run dies with it
            self._process.wait()
        if self._pipe is not None:
            self._pipe.close()
        self._process = self._pipe = None

    def close(self) -> None:
        """End the worker; its run, if any, ends unfinished. May be called from another thread."""
        self._closed = True
        if self._process is not None:
            self._process.kill()
            self._process.wait()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
        self._end()


def _started(theirs: Connection, work: Work) -> subprocess.Popen[bytes]:
    """The process, which finds the modules this one finds and hears no Ctrl-C of the terminal."""
    environment = {
        "MUJOCO_GL": "off",  # see hil.cli.main
        **os.environ,
        **BOUNDED,
        "PYTHONHASHSEED": "0",  # sets of names have one order in every worker
    }
    work_as_text = json.dumps({**asdict(work), "path": sys.path})
    return subprocess.Popen(
        [sys.executable, "-P", "-m", "hil.campaign.warm", str(theirs.fileno()), work_as_text],
        pass_fds=[theirs.fileno()],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        env=environment,
        start_new_session=True,
    )
