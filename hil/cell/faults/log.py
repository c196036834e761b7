"""What became of each fault: armed, active (its first effect was seen at its place), cleared."""

from dataclasses import dataclass
from enum import StrEnum


class Stage(StrEnum):
    ARMED = "armed"
    ACTIVE = "active"
    CLEARED = "cleared"


@dataclass(frozen=True, slots=True)
class FaultEvent:
    """t: bench time, ns. index: of the fault in the run's schedule. kind: id of its row."""

    t: int
    index: int
    kind: str
    stage: Stage
    detail: str = ""

    def __str__(self) -> str:
        detail = f": {self.detail}" if self.detail else ""
        return f"{self.kind} [{self.index}] {self.stage}{detail}"


def idle(events: tuple[FaultEvent, ...]) -> tuple[tuple[int, str], ...]:
    """(index, kind) of the faults that were armed and never active: such a run proves nothing."""
    armed = {(event.index, event.kind) for event in events if event.stage is Stage.ARMED}
    active = {(event.index, event.kind) for event in events if event.stage is Stage.ACTIVE}
    return tuple(sorted(armed - active))
