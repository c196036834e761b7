"""The referee of an insertion: what truly happened, by the plant's word alone."""

from controller.course import Course
from controller.cycle import Cycle
from hil.app.cell import RunningCell
from hil.cell.plant.interface import PlantStep
from hil.cell.rig import Rig

SEATED = 0.1e-3
"""How far off the slot's middle a tip inside it can be, m; beyond, it fell off the face."""


class Referee:
    """Watches the truth of one run; knows nothing of how it is scored elsewhere."""

    def __init__(self, rig: Rig) -> None:
        self._goal = rig.task.goal_depth
        self._bound = rig.limits.force_bound[:2]
        self._period = rig.robot.period
        self._first_over: int | None = None
        self._last = 0
        self.seated = False

    def watch(self, cycle: Cycle, course: Course, cell: RunningCell) -> None:
        truth = cell.truth()
        self._last = cycle.t
        part = truth.part
        if course.name == "insert" and part.name is not None:
            x, y, _ = part.tip
            self.seated = part.depth >= self._goal and max(abs(x), abs(y)) < SEATED
        self._count(truth, cycle.t)

    def _count(self, truth: PlantStep, t: int) -> None:
        means = abs(truth.wrenches[:, :2].mean(axis=0))
        over = bool((means > self._bound).any())
        if not over:
            self._first_over = None
        elif self._first_over is None:
            self._first_over = t

    def over(self) -> int:
        """Consecutive periods over the bound at the last watched one."""
        if self._first_over is None:
            return 0
        return (self._last - self._first_over) // self._period + 1
