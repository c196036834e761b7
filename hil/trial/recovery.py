"""After a stop, and once its cause is gone: how long the near side needs to be ready again."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Final

from controller.errors import ControlError
from controller.job import lift
from controller.loop import Loop
from controller.outcome import Kind
from controller.settings import Travel
from controller.start import resume
from drivers.errors import DriverError
from hil.app.inline import InlineCell
from hil.app.near import NearSide, limits, load, near_side, task_frame
from hil.cell.arm.modes import Event
from hil.cell.faults.log import FaultEvent, Stage
from hil.cell.faults.schedule import Numbered
from hil.cell.injection.cell import InjectedCell
from hil.cell.rig import Rig
from hil.trial.fmea import Entry

NS: Final = 1_000_000_000


def wanted(
    faults: Numbered, events: Sequence[FaultEvent], fmea: Mapping[str, Entry]
) -> tuple[int, ...]:
    """Faults that stopped the arm, are over, and from which the near side has to come back.

    None as long as another one is in force.
    """
    happened, over = _of(events, Stage.ACTIVE), _of(events, Stage.CLEARED)
    back = {index for index, fault in faults if fmea[fault.kind].comes_back(fault)}
    return tuple(sorted(back & over & happened)) if happened <= over else ()


def _of(events: Iterable[FaultEvent], stage: Stage) -> frozenset[int]:
    return frozenset(event.index for event in events if event.stage is stage)


def recover(cell: InlineCell, rig: Rig, patience: float) -> float | None:
    """Bench seconds from the permission of whoever attends the cell until a job could begin.

    None where the near side did not come back. An emergency stop is reset first, as at the pendant.
    patience: wall s of silence that are no dead link.
    """
    served, bench = cell.served, cell.served.bench
    assert isinstance(served, InjectedCell), "only a cell that fails has to be recovered"
    while served.deserted:
        cell.coast(1)
    bench.arm.box.post(Event.EMERGENCY_RESET)
    began = bench.t
    cell.serve_again()
    with near_side(rig, cell.doors, None, patience) as near:
        try:
            ready = resume(near.arm, near.sensor, lambda: _clear(near, rig), load=load(rig))
        except (DriverError, ControlError):
            return None
        return (ready.t - began) / NS


def _clear(near: NearSide, rig: Rig) -> None:
    """Lift the tool, and what it holds, out of whatever it was stopped in; raises ControlError."""
    loop = Loop(near.arm, near.sensor, task_frame(rig))
    outcome = loop.run(lambda course: lift(course, Travel()), limits(rig), leaving=True)
    if outcome.kind is not Kind.DONE:
        raise ControlError(f"the tool is not clear: {outcome.reason}")
