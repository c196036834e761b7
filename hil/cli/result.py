"""A run on the screen: how it goes, and how it went."""

from collections.abc import Iterator
from contextlib import contextmanager

from controller.course import Course
from controller.cycle import Cycle
from hil.app.run import Request, Result, Watch
from hil.cell.rig import Rig
from hil.view import tables
from hil.view.progress import RunProgress


@contextmanager
def watched(rig: Rig, *, quiet: bool) -> Iterator[Watch]:
    """What the run calls every period; shows on stderr when that is a terminal."""
    with RunProgress(rig.task.goal_depth, quiet=quiet) as progress:

        def watch(cycle: Cycle, course: Course) -> None:
            progress.update(cycle.t, course.name, -cycle.stage[2], cycle.wrench[2])

        yield watch


def text(request: Request, result: Result, *, json: bool) -> str:
    """The result as a table, or as one JSON object."""
    outcome, health = result.outcome, result.health
    facts: dict[str, str | int | float | None] = {
        "rig": request.rig.name,
        "seed": request.seed,
        "policy": request.policy,
        "outcome": outcome.kind.value,
        "reason": outcome.reason,
        "steps": outcome.steps,
        "bench_s": round(result.bench, 9),
        "wall_s": round(result.wall, 3),
        "real_time_factor": round(result.real_time_factor, 2),
        "periods_missed": outcome.misses,
        "samples_lost": health.gaps,
        "samples_torn": health.torn,
        "cell": result.description,
        "recording": str(request.out) if request.out else None,
        "sha256": result.digest,
    }
    return tables.as_json(facts) if json else tables.of_facts(facts)
