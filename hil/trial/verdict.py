"""From what a run showed to one word."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

from hil.monitors.monitor import Monitor
from hil.trial.always import Always
from hil.trial.signals import SCALES
from hil.trial.trace import Trace


class Verdict(StrEnum):
    """PASSED: safe throughout, and what was armed did happen. BLOCKED: nothing moved, as the rig
    could not begin. VACUOUS: a fault was armed and had no effect, so nothing is proven.
    """

    PASSED = "passed"
    FAILED = "failed"
    BLOCKED = "blocked"
    VACUOUS = "vacuous"
    HANG = "hang"
    CRASH = "crash"


@dataclass(frozen=True, slots=True)
class Violation:
    """Where a monitor was false first, and where worst. t: bench s. robustness: in scales."""

    monitor: str
    t: float
    phase: str
    robustness: float
    periods: int

    def __str__(self) -> str:
        return (
            f"{self.monitor} at {self.t:.3f} s in {self.phase}, {self.periods} periods, "
            f"worst by {-self.robustness:.3g}"
        )


@dataclass(frozen=True, slots=True)
class Judgement:
    """robustness: of each monitor in its worst period, scales. violations: of those that fell."""

    robustness: dict[str, float]
    violations: tuple[Violation, ...]


class Judge:
    """Monitors that run beside the loop: each period as it ends, in one pass."""

    def __init__(self, monitors: Sequence[Always]) -> None:
        self._monitors = monitors
        self._running = [Monitor(one.formula, SCALES) for one in monitors]
        self._worst = [float("inf")] * len(monitors)
        self._first: list[tuple[float, str] | None] = [None] * len(monitors)
        self._periods = [0] * len(monitors)

    @property
    def signals(self) -> Sequence[str]:
        """What a row must have, sorted; the time besides."""
        return sorted(frozenset({"t"}).union(*(monitor.signals for monitor in self._running)))

    def step(self, row: Mapping[str, float], phase: str) -> None:
        """Take the next period's values."""
        for n, monitor in enumerate(self._running):
            robustness, holds = monitor.step(row)
            self._worst[n] = min(self._worst[n], robustness)
            if not holds:
                self._first[n] = self._first[n] or (row["t"], phase)
                self._periods[n] += 1

    @property
    def judgement(self) -> Judgement:
        """Of all periods so far."""
        names = [one.name for one in self._monitors]
        found = zip(names, self._first, self._worst, self._periods, strict=True)
        return Judgement(
            dict(zip(names, self._worst, strict=True)),
            tuple(
                Violation(name, *first, worst, periods)
                for name, first, worst, periods in found
                if first is not None
            ),
        )


def judge(trace: Trace, monitors: Sequence[Always]) -> Judgement:
    """The same over a run that is over."""
    one = Judge(monitors)
    for row, phase in zip(trace.rows(one.signals), trace.phases, strict=True):
        one.step(row, phase)
    return one.judgement
