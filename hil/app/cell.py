"""What a composition root knows of a running cell, wherever it runs."""

from typing import NamedTuple, Protocol, Self

from hil.app.tap import Entry
from hil.cell.clock import Lateness
from hil.cell.faults.log import FaultEvent
from hil.cell.plant.interface import PlantStep
from hil.cell.serve import Doors


class CellReport(NamedTuple):
    """What a cell says when it has stopped. lateness: None in lockstep. faults: its own ones."""

    periods: int
    lateness: Lateness | None
    log: tuple[tuple[int, str], ...]
    faults: tuple[FaultEvent, ...] = ()


class RunningCell(Protocol):
    """A served cell in another thread or process; leaving the `with` stops it."""

    @property
    def doors(self) -> Doors: ...

    @property
    def description(self) -> str: ...

    @property
    def live(self) -> bool:
        """Whether `take` gives records while the cell runs."""
        ...

    def truth(self) -> PlantStep:
        """The plant now; only where the cell shares this process (CellError otherwise)."""
        ...

    def take(self) -> list[Entry]:
        """Records made since the last call; a cell in its own process gives them once stopped."""
        ...

    def note(self, phase: str, episode: int) -> None:
        """Where the job stands, before the command that lets a period pass; CellError for a cell
        without faults, which need not know.
        """
        ...

    def leave(self, duration: int) -> None:
        """The host is not there for so long, ns: in lockstep the cell goes on without it."""
        ...

    def stop(self) -> CellReport:
        """Stop, close every door; raises what the cell died of, if it did."""
        ...

    def __enter__(self) -> Self: ...
    def __exit__(self, *_: object) -> None: ...
