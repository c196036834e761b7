"""Runs an assembly for a person or a program: progress, table or JSON, exit status."""

from dataclasses import asdict
from pathlib import Path

import typer

from controller.course import Course
from controller.cycle import Cycle
from controller.outcome import Kind
from hil.app.cell import RunningCell
from hil.app.run import Request, Result, Watch, run
from hil.cell.faults.log import FaultEvent, idle
from hil.cli.errors import FAILED
from hil.recording.read import load
from hil.recording.summary import summarise
from hil.view.progress import RunProgress
from hil.view.tables import as_json, of_facts, of_lateness, of_run


def ignore(_cycle: Cycle, _course: Course, _cell: RunningCell) -> None:
    """The watcher that sees nothing."""


def perform(request: Request, watch: Watch, *, json: bool) -> Result:
    """Run it, showing how it goes on a terminal."""
    goal = request.rig.task.goal_depth
    with RunProgress(goal, quiet=json) as progress:

        def both(cycle: Cycle, course: Course, cell: RunningCell) -> None:
            progress.update(cycle.t, course.name, -cycle.stage.z, cycle.wrench[2])
            watch(cycle, course, cell)

        return run(request, both)


def report(result: Result, out: Path, *, json: bool) -> int:
    """Print what came of it, the digest last; the exit status."""
    if json:
        typer.echo(as_json(figures(result, out)), nl=False)
    else:
        typer.echo(of_run(summarise(load(out))), nl=False)
        typer.echo(of_facts(_speed(result)), nl=False)
        typer.echo(_events(result.faults), nl=False)
        typer.echo(f"{out / 'run.mcap'}\nsha256 {result.digest}")
    if unfelt := idle(result.faults):
        kinds = ", ".join(kind for _, kind in unfelt)
        typer.echo(f"hil: vacuous: {kinds} armed but never active; nothing is proven", err=True)
    return 0 if result.outcome.kind is Kind.INSERTED and not unfelt else FAILED


def _events(faults: tuple[FaultEvent, ...]) -> str:
    return "".join(f"{event.t * 1e-9:9.3f} s  {event}\n" for event in faults)


def figures(result: Result, out: Path) -> dict[str, object]:
    """A result as a program reads it; SI units."""
    outcome = result.outcome
    lateness = result.cell.lateness
    return {
        "outcome": outcome.kind.value,
        "reason": outcome.reason,
        "steps": outcome.steps,
        "cycles": outcome.cycles,
        "misses": outcome.misses,
        "standstill": outcome.standstill,
        "bench_s": result.bench,
        "wall_s": result.wall,
        "real_time_factor": result.real_time_factor,
        "cell": result.description,
        "sensor": result.health,
        "lateness_ns": lateness,
        "faults": [asdict(event) for event in result.faults],
        "recording": str(out / "run.mcap"),
        "sha256": result.digest,
    }


def _speed(result: Result) -> dict[str, str | int | float | None]:
    lines: dict[str, str | int | float | None] = {
        "cell": result.description,
        "steps": result.outcome.steps,
        "real-time factor": f"{result.real_time_factor:.1f} ({result.wall:.2f} s of wall time)",
    }
    if result.cell.lateness is not None:
        lines["lateness"] = of_lateness(result.cell.lateness)
    return lines
