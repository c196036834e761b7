"""A learner beside a 125 Hz loop by the wall clock: what it costs the loop, and its force.

The loop holds a force on the curved surface while it slides along it; the plant moves on with the
wall clock, so a set-point that comes late is a force that is wrong. Beside it learn: nobody; n
Python threads, as Algorithm 1 is printed; or the learner's own process with n agents.
"""

import gc
import os
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from math import pi, sin
from pathlib import Path
from threading import Event, Thread
from time import monotonic_ns

import numpy as np
from matplotlib.figure import Figure

from controller.action import Action, Observation
from controller.force_axis import press_law
from controller.laws.interface import AxisReading, Reference
from controller.outcome import Kind
from controller.settings import Press
from hil.cell.clock import Lateness, Schedule
from hil.cell.plant.interface import PlantStep, StageTarget
from hil.cell.plant.surface import SurfacePlant
from hil.cell.rig import Rig
from learner.beside.learner import BesideLearner
from learner.grid import Grid
from learner.interface import Transition
from learner.parallel.wdql import Parallel
from learner.tabular.settings import Tabular

GRID = Grid((5, 5, 3), (1.0, 1.0, 1.0))
G = 9.81
SETTLE = 2.0
"""s of contact that do not count."""
HALF, WAVE = 0.1, 20.0
"""The way along the surface: m to either side, s there and back."""


@dataclass(frozen=True, slots=True)
class Company:
    """Who learns beside the loop: `none`, `threads` or `process`, and with how many agents."""

    kind: str
    agents: int = 0

    @property
    def name(self) -> str:
        return self.kind if self.kind == "none" else f"{self.kind}, n = {self.agents}"


@dataclass(frozen=True, slots=True)
class Row:
    """One company. lateness: of the loop's periods, ns. force_rms, force_worst: error, N."""

    company: str
    lateness: Lateness
    force_rms: float
    force_worst: float


COMPANY = (
    Company("none"),
    *(Company("threads", n) for n in (1, 2, 4, 6)),
    *(Company("process", n) for n in (1, 6)),
)


def measure(rig: Rig, company: Company, seconds: float) -> Row:
    """The loop for so many wall seconds in this company."""
    with _learning(company), _first_in_line():
        loop, period = _Loop(rig), rig.robot.period
        schedule, begin = Schedule(period), monotonic_ns()
        done, wanted = 0, round(seconds * 1e9) // period
        while done < wanted:
            while (left := schedule.remaining()) > 0:
                schedule.nap(left)
            passed = max(1, (monotonic_ns() - begin) // period - done)
            for _ in range(passed):
                schedule.begin()
            loop.catch_up(passed)
            done += passed
        return Row(company.name, schedule.lateness(), *loop.errors)


class _Loop:
    """Plant, law and the way; the period's set-point holds until the next one is ready."""

    def __init__(self, rig: Rig) -> None:
        self._plant, self._period = SurfacePlant(rig), rig.robot.period
        self._law = press_law(Press(force=rig.task.contact_force, stiffness=10e3), self._period)
        self._reference = Reference(rig.task.contact_force)
        self._weight = rig.tool.mass * G
        self._z, self._t = 0.0, 0
        self._step: PlantStep = self._plant.reset(StageTarget(0, 0, 0, 0, jaws_closed=False))
        self._pushes: list[float] = []

    def catch_up(self, periods: int) -> None:
        """The plant moves on by all that passed since the last period, then the law decides."""
        target = StageTarget(self._x, 0.0, self._z, 0.0, jaws_closed=False)
        for _ in range(periods):
            self._step = self._plant.step(target, self._period)
            self._t += self._period
            self._pushes.append(self._push)
        reading = AxisReading(self._t, (self._push,), self._step.stage[2])
        self._z += self._law.step(reading, self._reference)

    @property
    def errors(self) -> tuple[float, float]:
        """RMS and worst error of the force after it settled, N."""
        skip = round(SETTLE * 1e9 / self._period)
        error = np.array(self._pushes[skip:]) - self._reference.force
        return float(np.sqrt(np.mean(error**2))), float(np.abs(error).max())

    @property
    def _push(self) -> float:
        return self._weight - float(self._step.wrenches[:, 2].mean())

    @property
    def _x(self) -> float:
        return HALF * sin(2 * pi * self._t * 1e-9 / WAVE)


@contextmanager
def _first_in_line() -> Iterator[None]:
    """The loop under SCHED_FIFO where the system allows it, its children not."""
    before = os.sched_getscheduler(0)
    with suppress(PermissionError):
        os.sched_setscheduler(0, os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, os.sched_param(50))
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()
        os.sched_setscheduler(0, before, os.sched_param(0))


def fifo_allowed() -> bool:
    """Whether the loop gets SCHED_FIFO; without it, other programs delay it."""
    with _first_in_line():
        return bool(os.sched_getscheduler(0) & os.SCHED_FIFO)


@contextmanager
def _learning(company: Company) -> Iterator[None]:
    settings = Parallel(Tabular(), agents=company.agents)
    with ExitStack() as stack:
        if company.kind == "threads":
            stack.enter_context(_threads(company.agents))
        elif company.kind == "process":
            learner = stack.enter_context(BesideLearner(GRID, settings, np.random.default_rng(1)))
            learner.observe(_success())  # the agents begin with the first one
        yield


@contextmanager
def _threads(count: int) -> Iterator[None]:
    """Algorithm 1 as printed: threads on shared tables, in the loop's own process."""
    stop = Event()
    tables = [[[0.0] * 6 for _ in range(GRID.states)] for _ in range(2)]
    threads = [Thread(target=_agent, args=(tables, stop, n), daemon=True) for n in range(count)]
    for thread in threads:
        thread.start()
    try:
        yield
    finally:
        stop.set()
        for thread in threads:
            thread.join()


def _agent(tables: list[list[list[float]]], stop: Event, seed: int) -> None:
    """One agent's double Q-learning on the grid, a reward at one pose."""
    dice = np.random.default_rng(seed)
    row, goal = 0, GRID.states - 1
    while not stop.is_set():
        own, other = (tables[0], tables[1]) if dice.random() < 0.5 else (tables[1], tables[0])
        values = [a + b for a, b in zip(own[row], other[row], strict=True)]
        greedy = dice.random() < 0.85
        action = _best(values) if greedy and any(values) else int(dice.integers(6))
        after = GRID.row(GRID.moved(GRID.at(row), Action(action)))
        target = 1.0 if after == goal else 0.9 * other[after][_best(own[after])]
        own[row][action] += 0.01 * (target - own[row][action])
        row = 0 if after == goal else after


def _best(values: list[float]) -> int:
    """`values.index(max(values))` raises when another thread writes in between: it did."""
    return max(range(len(values)), key=values.__getitem__)


def _success() -> Transition:
    near, there = (Observation(0, 0, 5, 0, x, 5, 0, 3) for x in (4, 5))
    return Transition(near, Action.PLUS_X, there, 5, Kind.INSERTED)


def draw(rows: list[Row], seconds: float, path: Path) -> None:
    """Lateness and force error by company."""
    sheet = Figure(figsize=(9, 4), layout="constrained")
    late, force = sheet.subplots(1, 2, sharey=True)
    names = [row.company for row in rows]
    at = np.arange(len(rows))
    late.barh(at - 0.2, [row.lateness.p99 * 1e-6 for row in rows], 0.4, label="p99 [ms]")
    share = [100 * row.lateness.missed / row.lateness.periods for row in rows]
    late.barh(at + 0.2, share, 0.4, label="missed periods [%]")
    late.set(yticks=at, yticklabels=names, xscale="symlog", title=f"lateness, {seconds:g} s each")
    late.legend(fontsize=8)
    late.invert_yaxis()
    force.barh(at, [row.force_rms for row in rows], 0.5, color="#1f5fa8")
    force.set(xlabel="RMS error [N]", title="force tracking on the curved surface")
    for panel in (late, force):
        panel.grid(axis="x", alpha=0.3)
    sheet.savefig(path, dpi=110)


def as_text(rows: list[Row]) -> str:
    """A line a company."""
    lines = [
        f"{'beside the loop':16s}{'p50 us':>9s}{'p99 us':>9s}{'max us':>10s}{'missed':>9s}"
        f"{'RMS N':>8s}{'worst N':>9s}"
    ]
    for row in rows:
        late = row.lateness
        lines.append(
            f"{row.company:16s}{late.p50 * 1e-3:9.0f}{late.p99 * 1e-3:9.0f}{late.max * 1e-3:10.0f}"
            f"{100 * late.missed / late.periods:8.1f}%{row.force_rms:8.2f}{row.force_worst:9.2f}"
        )
    return "\n".join(lines) + "\n"
