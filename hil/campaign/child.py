"""The process of one run: calls the function, sends what it returned, and is gone."""

import ctypes
import faulthandler
import os
import signal
import sys
import traceback
from multiprocessing.connection import Connection

from hil.campaign.function import named
from hil.campaign.run import Outcome, Report, Run, Verdict, canonical, encode

WHERE = signal.SIGUSR1
"""Asks a hanging run to write where it hangs, before it is killed."""

PR_SET_PDEATHSIG = 1
"""prctl(2)."""


def main(run: Run, reply: Connection, output: int) -> None:
    """Everything the run prints, faults included, goes to the file descriptor `output`."""
    os.setsid()  # whatever the run starts shares its group and ends with it
    _die_with_parent()
    for stream in (1, 2):
        os.dup2(output, stream)
    faulthandler.enable(output)
    faulthandler.register(WHERE, output)
    reply.send_bytes(encode(perform(run)))


def perform(run: Run) -> Outcome:
    """Call the run's function here; an exception is an outcome, a crash is not survived."""
    try:
        report = named(run.function)(run)
        if not isinstance(report, Report):
            kind = type(report).__name__
            raise TypeError(f"{run.function} returned {kind}, not a Report")
        canonical(report.figures), canonical(report.timing)
    except (Exception, SystemExit) as error:
        words = " ".join(f"{type(error).__name__}: {error}".split())
        return Outcome(Verdict.ERROR, words, trace=traceback.format_exc())
    return Outcome(report.verdict, report.reason, report.figures, report.timing)


def _die_with_parent() -> None:
    """Linux: a run whose worker was killed would otherwise go on for nobody."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
