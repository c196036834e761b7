"""A cell with or without faults, and what became of them."""

from hil.app.tap import Entry
from hil.cell.errors import CellError
from hil.cell.faults.log import FaultEvent
from hil.cell.faults.schedule import Numbered
from hil.cell.injection.cell import InjectedCell
from hil.cell.rig import Rig
from hil.cell.serve import ServedCell
from hil.recording.channel import Channel
from hil.recording.channels import event
from hil.recording.channels.event import EventKind


def served(rig: Rig, seed: int, faults: Numbered | None, *, across_processes: bool) -> ServedCell:
    """The cell with its doors open; with `faults`, none of them too, it can be told of the job."""
    from hil.cell.assemble import serve, serve_with_faults  # noqa: PLC0415  MuJoCo loads here

    if faults is None:
        return serve(rig, seed, across_processes)
    return serve_with_faults(rig, seed, across_processes, faults)


def failing(cell: ServedCell) -> InjectedCell:
    """The cell as one that fails; CellError for a sound one."""
    if not isinstance(cell, InjectedCell):
        raise CellError("this cell was opened without faults")
    return cell


class Teller:
    """What has happened to a cell's faults since it was asked last, as records of the period."""

    def __init__(self, cell: ServedCell) -> None:
        self._cell, self._told = cell, 0

    def __call__(self, t: int) -> list[Entry]:
        """Records at the end of the period, t in ns."""
        found = events(self._cell)
        new, self._told = found[self._told :], len(found)
        return [(t, Channel.EVENT, event.encode(EventKind.FAULT, str(one))) for one in new]


def events(cell: ServedCell) -> tuple[FaultEvent, ...]:
    """What became of the cell's faults; nothing in a sound one."""
    return cell.events if isinstance(cell, InjectedCell) else ()
