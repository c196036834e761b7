"""What truly happened in a run: the push on the tool at 1 kHz and where the tool was."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.course import Course
from controller.cycle import Cycle
from hil.app.cell import RunningCell
from hil.cell.plant.interface import PlantStep

Array = NDArray[np.float64]
G = 9.81
TOUCH = 0.2
"""True push that counts as contact, N: above what the tool's inertia makes in free air."""


class Trace(NamedTuple):
    """push: true force along z less the tool's weight, at 1 kHz, N (n,). touch, slide: indices of
    the first true contact and of the motion's beginning, None where the run never got there.
    place: x, z of the tool at each period's end, m (m, 2). period: ms.
    """

    push: Array
    touch: int | None
    slide: int | None
    place: Array
    period: int


def trace_of(
    steps: Sequence[PlantStep], mass: float, lower: int | None, slide: int | None
) -> Trace:
    """The trace of a run from the way down on; lower, slide: where these phases begin in steps."""
    if lower is None or lower >= len(steps):
        return Trace(np.empty(0), None, None, np.empty((0, 2)), 1)
    kept = steps[lower:]
    push = mass * G - np.concatenate([step.wrenches[:, 2] for step in kept])
    period = len(kept[0].wrenches)
    felt = np.flatnonzero(push > TOUCH)
    touch = int(felt[0]) if len(felt) else None
    place = np.array([(step.stage[0], step.stage[2]) for step in kept])
    begin = None if slide is None else (slide - lower) * period
    return Trace(push, touch, begin, place, period)


class Tracer:
    """Collects a run's truth, period by period; the cell stands still meanwhile in lockstep."""

    def __init__(self, mass: float) -> None:
        self._mass = mass
        self._steps: list[PlantStep] = []
        self._lower: int | None = None
        self._slide: int | None = None

    def watch(self, _cycle: Cycle, course: Course, cell: RunningCell) -> None:
        self._steps.append(cell.truth())
        if self._lower is None and course.name == "lower":
            self._lower = len(self._steps)
        if self._slide is None and course.name == "slide":
            self._slide = len(self._steps)

    def trace(self) -> Trace:
        return trace_of(self._steps, self._mass, self._lower, self._slide)
