"""One core for threads that take turns.

In lockstep the controller's thread and the cell's never run at once. On two cores every hand-over
wakes the other core and leaves the first one's cache cold: a quarter of the loop's time, measured.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_PROCESSOR = 36
"""Field 39 of /proc/PID/stat (proc(5)), counted from behind the command's name."""


@contextmanager
def on_one_core(*, wanted: bool) -> Iterator[None]:
    """Keep this thread, and those it starts, on the core it runs on; no effect off Linux."""
    if not wanted or not hasattr(os, "sched_setaffinity"):
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {_core()})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)


def _core() -> int:
    text = Path("/proc/thread-self/stat").read_text(encoding="utf-8")
    return int(text.rpartition(")")[2].split()[_PROCESSOR])
