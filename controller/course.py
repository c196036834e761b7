"""The thread that runs through a job: last cycle, last set-point, phase and step count."""

from collections.abc import Callable, Generator
from typing import TypeAlias, TypeVar

from controller.cycle import Cycle
from controller.errors import PartLostError
from controller.place import Place
from drivers.interfaces import ArmState

R = TypeVar("R")
Phase: TypeAlias = Generator[Place, Cycle, R]
"""A phase yields a set-point, receives the next cycle, and returns how it ended."""

LOST = 3
"""Cycles: a contact that bounces once has not lost the part."""


class Course:
    """Where a job stands. Phases move it on; the loop, recorders and screens read it.

    period: of the control loop, s. name: of the running phase. steps: search steps taken (k).
    refused: actions of the policy that were none. held: periods spent waiting for its answer.
    """

    __slots__ = (
        "_holds", "_lost", "cycle", "held", "name", "period", "refused", "setpoint", "steps",
    )  # fmt: skip

    def __init__(self, cycle: Cycle, period: float) -> None:
        self.cycle = cycle
        self.setpoint = cycle.stage
        self.period = period
        self.name = "start"
        self.steps = 0
        self.refused = 0
        self.held = 0
        self._holds: Callable[[ArmState], bool] | None = None
        self._lost = 0

    def carry(self, holds: Callable[[ArmState], bool] | None) -> None:
        """From here on the jaws must feel the part in every cycle; None: they need not.

        PartLostError, as soon as they have not for `LOST` cycles: nothing is inserted with empty
        hands, and the force of a part that hangs askew says nothing of the slot.
        """
        self._holds, self._lost = holds, 0

    def to(self, place: Place) -> Phase[Cycle]:
        """Send one set-point and wait for the cycle that follows it."""
        self.setpoint = place
        self.cycle = yield place
        if self._holds is not None:
            self._lost = 0 if self._holds(self.cycle.state) else self._lost + 1
            if self._lost >= LOST:
                self._holds = None
                raise PartLostError(f"part lost: jaws felt nothing in {LOST} cycles of {self.name}")
        return self.cycle

    def dwell(self, duration: float) -> Phase[Cycle]:
        """Stay at the last set-point for so many seconds."""
        for _ in range(max(1, round(duration / self.period))):
            yield from self.to(self.setpoint)
        return self.cycle
