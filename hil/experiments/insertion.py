"""Insertions over many seeds: how often, in how many steps, and what stopped the others."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from pydantic import TypeAdapter

from controller.outcome import Kind
from hil.app.near import part_named
from hil.app.run import Request
from hil.app.run import run as perform
from hil.campaign.plan import Plan, grid
from hil.campaign.run import Outcome, Report, Run, Verdict
from hil.cell.rig import parse
from hil.experiments import warm_up
from hil.experiments.referee import Referee
from hil.experiments.statistics import wilson

LIMIT = 300.0
"""Wall seconds of a run; one takes 2 to 6 on an idle core."""


@dataclass(frozen=True, slots=True)
class Row:
    """One run. kind: how the job ended, or the runner's verdict on one that broke.

    seated: whether the part truly was at goal depth in the slot when released.
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


def plan(rig: str, part: str, policy: str, seeds: range) -> Plan:
    """A run in lockstep for each seed, without a recording; RigError for a part there is not."""
    part_named(parse(rig), part)
    return grid(
        f"{__name__}:one",
        rig,
        seeds,
        variants=[{"part": part, "policy": policy}],
        limit=LIMIT,
        prepare=f"{warm_up.__name__}:cell",
    )


def one(run: Run) -> Report:
    """Insert the part once; passed when it truly sits in the slot."""
    rig = parse(run.rig).on_free_ports()
    referee = Referee(rig)
    part, policy = str(run.variant["part"]), str(run.variant["policy"])
    result = perform(Request(rig, b"", run.seed, part, policy), referee.watch)
    outcome = result.outcome
    seated = referee.seated and outcome.kind is Kind.INSERTED
    return Report(
        figures={
            "kind": outcome.kind.value,
            "steps": outcome.steps,
            "seconds": result.bench,
            "seated": seated,
            "over": referee.over() + 1 if outcome.kind is Kind.DANGER else 0,
        },
        verdict=Verdict.PASSED if seated else Verdict.FAILED,
        reason=outcome.reason,
        timing={"real_time_factor": result.real_time_factor},
    )


def rows(plan: Plan, outcomes: Sequence[Outcome]) -> list[Row]:
    """A row for each run of the plan, those that broke included."""
    return [_row(run.seed, outcome) for run, outcome in zip(plan.runs, outcomes, strict=True)]


def _row(seed: int, outcome: Outcome) -> Row:
    if outcome.verdict.broken:
        verdict = outcome.verdict.value
        return Row(seed, verdict, outcome.reason, 0, 0.0, 0.0, seated=False, over=0)
    found = {"seed": seed, "reason": outcome.reason, **outcome.figures, **outcome.timing}
    return TypeAdapter(Row).validate_python(found)


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
    low, high = wilson(len(good), len(series))
    return Summary(
        runs=len(series),
        inserted=len(good),
        success=len(good) / len(series),
        success_low=low,
        success_high=high,
        steps_median=median(row.steps for row in good) if good else 0.0,
        endings=dict(Counter(row.kind for row in series)),
        worst_over=max(row.over for row in series),
    )
