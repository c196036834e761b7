"""Insertions over many seeds: how often, in how many steps, and what stopped the others."""

from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from statistics import median

from scipy.stats import binomtest  # type: ignore[attr-defined]  # re-exported beyond mypy's sight

from controller.course import Course
from controller.cycle import Cycle
from controller.outcome import Kind
from hil.app.cell import RunningCell
from hil.app.process import uninterrupted
from hil.app.run import Request, run
from hil.cell.plant.interface import PlantStep
from hil.cell.rig import Rig

SEATED = 0.1e-3
"""How far off the slot's middle a tip inside it can be, m; beyond, it fell off the face."""


@dataclass(frozen=True, slots=True)
class Row:
    """One run. seated: whether the part truly was at goal depth in the slot when released.

    over: control periods that the force bound was passed for, up to and with the one in which the
    guard sent the stop, judged by the true lateral means; 0 when it sent none.
    """

    seed: int
    kind: str
    reason: str
    steps: int
    seconds: float
    real_time_factor: float
    seated: bool
    over: int


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


def one(rig: Rig, seed: int, part: str, policy: str) -> Row:
    """One run in lockstep, without a recording."""
    referee = Referee(rig)
    result = run(Request(rig.on_free_ports(), b"", seed, part, policy), referee.watch)
    outcome = result.outcome
    return Row(
        seed,
        outcome.kind.value,
        outcome.reason,
        outcome.steps,
        result.bench,
        result.real_time_factor,
        referee.seated and outcome.kind is Kind.INSERTED,
        referee.over() + 1 if outcome.kind is Kind.DANGER else 0,
    )


def rows(rig: Rig, part: str, policy: str, seeds: range, workers: int = 2) -> Iterator[Row]:
    """The runs, in the order of their seeds, several at a time in processes of their own."""
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        jobs = zip(*((rig, seed, part, policy) for seed in seeds), strict=True)
        with uninterrupted():
            results = pool.map(one, *jobs)
        yield from results


@dataclass(frozen=True, slots=True)
class Summary:
    """Figures of a series; success with its 95 % Wilson interval, steps of the successful."""

    runs: int
    inserted: int
    success: float
    success_low: float
    success_high: float
    steps_median: float
    endings: dict[str, int]
    worst_over: int


def summary(series: list[Row]) -> Summary:
    """What a series of runs shows; a part that is not truly seated is no success."""
    good = [row for row in series if row.seated]
    interval = binomtest(len(good), len(series)).proportion_ci(method="wilson")
    return Summary(
        runs=len(series),
        inserted=len(good),
        success=len(good) / len(series),
        success_low=float(interval.low),
        success_high=float(interval.high),
        steps_median=median(row.steps for row in good) if good else 0.0,
        endings=dict(Counter(row.kind for row in series)),
        worst_over=max(row.over for row in series),
    )
