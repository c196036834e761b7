"""A worker's process: all imports done once, then one fork for every run, which costs milliseconds.

It has no thread of its own and writes nothing, so that a fork of it is sound. It imports neither
numpy nor a cell before its environment (see slot.py) bounds their threads.
"""

import gc
import json
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from multiprocessing import get_context
from multiprocessing.connection import Connection, Pipe, wait
from multiprocessing.process import BaseProcess
from tempfile import TemporaryFile
from time import perf_counter
from typing import IO

from hil.campaign import child
from hil.campaign.function import named
from hil.campaign.run import Outcome, Run, Verdict, decode_outcome, decode_run, encode

TRACE = 4096
"""Bytes kept of what a run that broke printed last."""

DUMP = 0.2
"""Wall seconds that a hanging run has to write where it hangs."""


def serve(pipe: Connection, limit: float, function: str, prepare: str) -> None:
    """Perform runs from `pipe`, one at a time, until it closes. limit: wall s of a run."""
    with suppress(EOFError, BrokenPipeError):
        pipe.send_bytes(b"ready")
        run = decode_run(pipe.recv_bytes())
        _prepare(run, function, prepare)
        while True:
            pipe.send_bytes(encode(isolated(run, limit, pipe)))
            run = decode_run(pipe.recv_bytes())


def _prepare(run: Run, function: str, prepare: str) -> None:
    # What fails here fails in the run as well, and is that run's verdict.
    with suppress(Exception):
        named(function)
        if prepare:
            named(prepare)(run)
    gc.collect()
    gc.freeze()  # a collection in the fork would touch, and so copy, every page


def isolated(run: Run, limit: float, client: Connection) -> Outcome:
    """One run in a process of its own; EOFError when the client is gone meanwhile."""
    began = perf_counter()
    with TemporaryFile() as output, _forked(run, output) as (process, reply):
        ready = wait([reply, process.sentinel, client], limit)
        if reply in ready:
            outcome = _received(reply, process, output)
        elif process.sentinel in ready:
            outcome = _crash(process, output)
        elif client in ready:
            raise EOFError
        else:
            outcome = _hang(process, limit, output)
    return replace(outcome, wall=round(perf_counter() - began, 3))


@contextmanager
def _forked(run: Run, output: IO[bytes]) -> Iterator[tuple[BaseProcess, Connection]]:
    """The run's process and the pipe it answers on; neither outlives the block."""
    reply, theirs = Pipe(duplex=False)
    process = get_context("fork").Process(target=child.main, args=(run, theirs, output.fileno()))
    process.start()
    theirs.close()
    try:
        yield process, reply
    finally:
        _end(process)
        reply.close()


def _end(process: BaseProcess) -> None:
    """Kill the run and whatever it started."""
    process.kill()
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid or 0, signal.SIGKILL)
    process.join()


def _received(reply: Connection, process: BaseProcess, output: IO[bytes]) -> Outcome:
    try:
        return decode_outcome(reply.recv_bytes())
    except EOFError:
        return _crash(process, output)


def _crash(process: BaseProcess, output: IO[bytes]) -> Outcome:
    process.join()
    code = process.exitcode or 0
    how = signal.Signals(-code).name if code < 0 else f"exit status {code}"
    return Outcome(Verdict.CRASH, f"ended by {how}", trace=_tail(output))


def _hang(process: BaseProcess, limit: float, output: IO[bytes]) -> Outcome:
    if process.pid is not None:
        os.kill(process.pid, child.WHERE)
    process.join(DUMP)
    return Outcome(Verdict.HANG, f"no result within {limit:g} s", trace=_tail(output))


def _tail(output: IO[bytes]) -> str:
    size = output.seek(0, os.SEEK_END)
    output.seek(max(0, size - TRACE))
    return output.read().decode(errors="replace")


def main(descriptor: str, work: str) -> None:
    """Serve on an inherited file descriptor; `work` is JSON, see slot.py."""
    settings = json.loads(work)
    # Set here, not by PYTHONPATH, which would let a script's folder shadow the standard library.
    sys.path[:] = settings["path"]
    with Connection(int(descriptor)) as pipe:
        serve(pipe, settings["limit"], settings["function"], settings["prepare"])


if __name__ == "__main__":
    main(*sys.argv[1:])
