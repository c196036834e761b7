"""What truly happened in a run: the push on the tool at 1 kHz and where the tool was."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.course import Course
from controller.cycle import Cycle
from hil.app.cell import RunningCell

Array = NDArray[np.float64]
G = 9.81


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


TOUCH = 0.2
"""True push that counts as contact, N: above what the tool's inertia makes in free air."""


class Tracer:
    """Collects a run's truth, period by period; the cell stands still meanwhile in lockstep."""

    def __init__(self, mass: float) -> None:
        self._weight = mass * G
        self._pushes: list[Array] = []
        self._places: list[tuple[float, float]] = []
        self._lower: int | None = None
        self._slide: int | None = None

    def watch(self, _cycle: Cycle, course: Course, cell: RunningCell) -> None:
        truth = cell.truth()
        self._pushes.append(truth.wrenches[:, 2])
        self._places.append((truth.stage[0], truth.stage[2]))
        if self._lower is None and course.name == "lower":
            self._lower = len(self._pushes)
        if self._slide is None and course.name == "slide":
            self._slide = len(self._pushes)

    def trace(self) -> Trace:
        """Everything from the way down on."""
        first = self._lower
        if first is None:
            return Trace(np.empty(0), None, None, np.empty((0, 2)), 1)
        kept = self._pushes[first:]
        push = self._weight - (np.concatenate(kept) if kept else np.empty(0))
        period = len(kept[0]) if kept else 1
        felt = np.flatnonzero(push > TOUCH)
        slide = None if self._slide is None else (self._slide - first) * period
        touch = int(felt[0]) if len(felt) else None
        return Trace(push, touch, slide, np.array(self._places[first:]).reshape(-1, 2), period)
