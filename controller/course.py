"""The thread that runs through a job: last cycle, last set-point, phase and step count."""

from collections import deque
from collections.abc import Callable, Generator
from math import dist
from typing import Final, TypeAlias, TypeVar

from controller.cycle import Cycle
from controller.errors import PartLostError
from controller.place import Place
from drivers.interfaces import ArmState

R = TypeVar("R")
Phase: TypeAlias = Generator[Place, Cycle, R]
"""A phase yields a set-point, receives the next cycle, and returns how it ended."""

LOST: Final = 3
"""Cycles: a contact that bounces once has not lost the part."""
IN_FREE_AIR: Final = frozenset(("pick up", "approach", "put down"))
"""Phases that expect no contact: whatever is met there is drawn back from."""
CLEAR: Final = 5e-3
"""m that an arm draws back from what it met: further than it was pushed in."""
_REMEMBERED: Final = 256
"""Set-points kept: two seconds at 125 Hz."""


class Course:
    """Where a job stands. Phases move it on; the loop, recorders and screens read it.

    period: of the control loop, s. name: of the running phase. steps: search steps taken (k).
    refused: actions of the policy that were none. held: periods spent waiting for its answer.
    """

    __slots__ = (
        "_holds", "_lost", "_trail", "cycle", "held", "name", "period", "refused", "setpoint",
        "steps",
    )  # fmt: skip

    def __init__(self, cycle: Cycle, period: float) -> None:
        self.cycle = cycle
        self.setpoint = cycle.stage
        self.period = period
        self.name = "start"
        self.steps = 0
        self.refused = 0
        self.held = 0
        self._trail: deque[Place] = deque([self.setpoint], maxlen=_REMEMBERED)
        self._holds: Callable[[ArmState], bool] | None = None
        self._lost = 0

    def carry(self, holds: Callable[[ArmState], bool] | None) -> None:
        """From here on the jaws must feel the part in every cycle; None: they need not.

        PartLostError, as soon as they have not for `LOST` cycles: nothing is inserted with empty
        hands, and the force of a part that hangs askew says nothing of the slot.
        """
        self._holds, self._lost = holds, 0

    @property
    def way_back(self) -> Place | None:
        """Where to draw back to on the way that led here; None where contact is expected."""
        if self.name not in IN_FREE_AIR:
            return None
        here = self.setpoint
        behind = (at for at in reversed(self._trail) if dist(at[:3], here[:3]) >= CLEAR)
        return next(behind, self._trail[0])

    def to(self, place: Place) -> Phase[Cycle]:
        """Send one set-point and wait for the cycle that follows it."""
        self.setpoint = place
        self._trail.append(place)
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
