"""Search and shrink on whole runs of a rig: what is tried is a schedule, what is judged a trial."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

from hil.cell.faults.schedule import Schedule
from hil.cell.rig import Rig
from hil.falsify.faults import Described, schedule, space
from hil.falsify.search import Told, search
from hil.falsify.shrink import shrink
from hil.falsify.space import Case
from hil.trial.trial import Trial, run_trial
from hil.trial.verdict import Verdict

GRAVE = -10.0
"""Robustness of a run that hung or crashed: worse than any monitor says."""


@dataclass(frozen=True, slots=True)
class Attempt:
    """What every run of a search has in common. formula: "" takes the always-on monitors."""

    rig: Rig
    seed: int
    policy: str = "pose"
    formula: str = ""

    def run(self, faults: Schedule | None) -> Trial:
        return run_trial(self.rig, self.seed, faults, policy=self.policy)

    def robustness(self, trial: Trial) -> float:
        """Below 0: it violates. A run in which the fault never happened shows nothing."""
        if trial.verdict in (Verdict.HANG, Verdict.CRASH):
            return GRAVE
        found = trial.trace.robustness(self.formula) if self.formula else trial.worst
        return found if found < inf else 0.0


@dataclass(frozen=True, slots=True)
class Worst:
    """The worst schedule that a search found, and what a run under it came to."""

    schedule: Schedule
    robustness: float
    runs: int

    @property
    def violated(self) -> bool:
        return self.robustness < 0.0


def falsify(
    attempt: Attempt, kinds: list[str], *, faults: int, budget: int, seed: int, tell: Told
) -> Worst:
    """Search schedules of so many faults of these kinds, by TPE, for the least robustness."""
    found = search(
        [space(kinds)] * faults,
        lambda case: attempt.robustness(attempt.run(schedule(case))),
        budget=budget,
        seed=seed,
        tell=tell,
    )
    return Worst(schedule(found.case), found.robustness, found.runs)


@dataclass(frozen=True, slots=True)
class Least:
    """The least schedule that still violates. any_value: parameters that do not matter."""

    schedule: Schedule
    any_value: tuple[str, ...]
    runs: int


def shrunk(attempt: Attempt, found: Schedule, *, budget: int, tell: Callable[[int], None]) -> Least:
    """Shrink a violating schedule; ValueError when a run under it violates nothing."""
    described, runs = Described(found), 0

    def violates(case: Case) -> bool:
        nonlocal runs
        runs += 1
        tell(runs)
        trial = attempt.run(described.schedule(case))
        return attempt.robustness(trial) < 0.0

    least = shrink(described.case, described.space, violates, budget)
    names = sorted(described.name(least.case[index], axis) for index, axis in least.irrelevant)
    return Least(described.schedule(least.case), tuple(names), least.runs)
