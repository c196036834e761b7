"""What a lockstep run gains when it has the machine to itself."""

import gc
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_PROCESSOR = 36
"""Field 39 of /proc/PID/stat (proc(5)), counted from behind the command's name."""


@contextmanager
def undisturbed(*, wanted: bool) -> Iterator[None]:
    """Keep this thread, and those it starts, on the core it runs on; spare what is loaded the GC.

    In lockstep the controller's thread and the cell's never run at once. On two cores every
    hand-over wakes the other core and leaves the first one's cache cold: a quarter of the loop's
    time, measured. Walking the loaded modules in each full collection costs another 4 %.
    """
    if not wanted:
        yield
        return
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {_core()})
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()
        os.sched_setaffinity(0, cores)


def _core() -> int:
    text = Path("/proc/thread-self/stat").read_text(encoding="utf-8")
    return int(text.rpartition(")")[2].split()[_PROCESSOR])
