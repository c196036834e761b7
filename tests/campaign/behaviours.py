"""Functions that campaigns of the tests call: some behave, some do not."""

import os
import signal
import sys
import time
from pathlib import Path

from hil.campaign.run import Report, Run, Verdict


def square(run: Run) -> Report:
    return Report({"square": run.seed**2, "offset": run.variant.get("offset", 0)})


def mixed(run: Run) -> Report:
    """Seeds 17 and 58 crash, 42 hangs, 5 fails."""
    if run.seed == 17:
        os.abort()
    if run.seed == 58:
        os.kill(os.getpid(), signal.SIGSEGV)
    if run.seed == 42:
        time.sleep(3600)
    verdict = Verdict.FAILED if run.seed == 5 else Verdict.PASSED
    return Report({"square": run.seed**2}, verdict, timing={"cpu_s": time.process_time()})


def noted(run: Run) -> Report:
    """Leaves a mark for every time it was computed."""
    with Path(str(run.variant["marks"])).open("a", encoding="utf-8") as marks:
        marks.write(f"{run.seed}\n")
    return Report({"square": run.seed**2})


def raising(run: Run) -> Report:
    raise RuntimeError(f"no such\nthing as {run.seed}")


def leaving(run: Run) -> Report:
    sys.exit(3)


def quitting(run: Run) -> Report:
    os._exit(3)


def infinite(run: Run) -> Report:
    return Report({"force": float("inf")})


def careless(run: Run) -> Report:
    return {"square": 4}  # type: ignore[return-value]


def large(run: Run) -> Report:
    return Report({"text": "x" * 3_000_000})


def forking(run: Run) -> Report:
    """Leaves a process behind, and its number in the file that the variant names."""
    child = os.fork()
    if child == 0:
        time.sleep(3600)
    Path(str(run.variant["pid"])).write_text(str(child), encoding="utf-8")
    return Report({})


def sleeping(run: Run) -> Report:
    """Sleeps once its number is in the file that the variant names."""
    path = Path(str(run.variant["pid"]))
    path.with_suffix(".part").write_text(str(os.getpid()), encoding="utf-8")
    path.with_suffix(".part").rename(path)
    time.sleep(3600)
    return Report({})


def talking(run: Run) -> Report:
    print("to whom it may concern")
    return Report({"threads": os.environ["OMP_NUM_THREADS"]})


def worker(run: Run) -> Report:
    return Report({"worker": os.getppid()})


def prepared(run: Run) -> Report:
    return Report({"prepared": os.environ.get("PREPARED", "")})


def prepare(run: Run) -> None:
    os.environ["PREPARED"] = run.rig
