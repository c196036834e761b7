"""Runs a served cell by the clock that was asked for."""

from hil.app.cell import CellReport
from hil.app.faulty import events
from hil.cell.arm.urscript.parse import parse
from hil.cell.clock import Schedule
from hil.cell.serve import Observer, ServedCell, Stopped


def pace(cell: ServedCell, clock: str, stopped: Stopped, observe: Observer) -> CellReport:
    """Serve until stopped; clock is `lockstep` or `wall`."""
    return keep(cell, schedule(cell, clock), stopped, observe)


def schedule(cell: ServedCell, clock: str) -> Schedule | None:
    """The schedule of a cell that the wall clock paces, which begins now; None in lockstep."""
    if clock != "wall":
        return None
    # Builds the grammar's tables, 0.15 s: twenty missed periods, were it in the loop.
    parse("sync()\n")
    return Schedule(cell.bench.period)


def keep(
    cell: ServedCell, schedule: Schedule | None, stopped: Stopped, observe: Observer
) -> CellReport:
    """Serve until stopped, by the schedule or, without one, in lockstep."""
    if schedule is None:
        cell.lockstep(stopped, observe)
    else:
        cell.wall(stopped, observe, schedule)
    lateness = None if schedule is None else schedule.lateness()
    return CellReport(cell.bench.t // cell.bench.period, lateness, cell.bench.arm.log, events(cell))
