"""Many runs, several at a time, each worker on a core of its own; rows in a fixed order."""

import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from multiprocessing.queues import SimpleQueue
from typing import NamedTuple

from controller.errors import ControlError
from drivers.errors import DriverError
from hil.app.process import uninterrupted
from hil.cell.errors import CellError
from hil.cell.rig import Rig
from hil.experiments.force_tracking.run import Row, run
from hil.experiments.force_tracking.variant import Variant


class Job(NamedTuple):
    """One run to be made."""

    rig: Rig
    seed: int
    variant: Variant


def rows(jobs: Sequence[Job], workers: int) -> Iterator[Row]:
    """The runs' rows in the order of the jobs, whatever order they end in."""
    context = get_context("spawn")
    cores: SimpleQueue[int] = context.SimpleQueue()
    for _, core in zip(range(workers), _cores(workers), strict=False):
        cores.put(core)
    with ProcessPoolExecutor(workers, context, initializer=_take, initargs=(cores,)) as pool:
        with uninterrupted():
            results = pool.map(one, jobs, chunksize=1)
        yield from results


def one(job: Job) -> Row:
    """A run's row; a run that never came about is a row that says so."""
    try:
        return run(job.rig, job.seed, job.variant.as_json())
    except (CellError, DriverError, ControlError) as error:
        return {"failed": True, "unstable": False, "ending": f"{type(error).__name__}: {error}"}


def _cores(workers: int) -> list[int]:
    allowed = sorted(os.sched_getaffinity(0))
    return [allowed[i % len(allowed)] for i in range(workers)]


def _take(cores: "SimpleQueue[int]") -> None:
    """Stay on one core: a run's two threads take turns, and waking another core costs a quarter."""
    os.sched_setaffinity(0, {cores.get()})
