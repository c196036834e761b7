"""From what a run showed to one word."""

from collections.abc import Sequence
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


def judge(trace: Trace, monitors: Sequence[Always]) -> Judgement:
    """Every monitor over the whole run, in one pass."""
    running = [Monitor(one.formula, SCALES) for one in monitors]
    names = sorted(frozenset().union(*(monitor.signals for monitor in running)))
    worst = [float("inf")] * len(running)
    false: list[list[int]] = [[] for _ in running]
    for period, row in enumerate(trace.rows(names)):
        for n, monitor in enumerate(running):
            robustness, holds = monitor.step(row)
            worst[n] = min(worst[n], robustness)
            if not holds:
                false[n].append(period)
    violations = tuple(
        Violation(one.name, float(trace["t"][at[0]]), trace.phases[at[0]], worst[n], len(at))
        for n, (one, at) in enumerate(zip(monitors, false, strict=True))
        if at
    )
    return Judgement(dict(zip((one.name for one in monitors), worst, strict=True)), violations)
