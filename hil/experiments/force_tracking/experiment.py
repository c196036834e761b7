"""The whole experiment as a campaign: a grid, some seeds, one table; and the figure's own runs."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path

from hil.campaign.plan import Plan
from hil.campaign.run import Outcome, Report, Run, Verdict
from hil.cell.rig import parse
from hil.experiments import warm_up
from hil.experiments.force_tracking.grid import Grid
from hil.experiments.force_tracking.run import Row, run
from hil.experiments.force_tracking.table import Series, series
from hil.experiments.force_tracking.variant import Variant

LIMIT = 120.0
"""Wall seconds of a run; one takes 2 to 8."""
FIGURE_SEEDS = 5
"""Runs behind each curve of the figure: as many as the paper's."""


def plan(rigs: Mapping[int, str], grid: Grid, seeds: range, out: Path | None) -> Plan:
    """Every rate's rig (its text) with every variant and seed.

    The first run of each series is recorded below `out`.
    """
    return _planned(
        Run(
            f"{__name__}:one",
            text,
            seed,
            _recorded(variant, rate, out if seed == seeds[0] else None).as_json(),
        )
        for rate, text in rigs.items()
        for variant in grid.variants()
        for seed in seeds
    )


def one(planned: Run) -> Report:
    """Track once; failed when the contact was unstable."""
    text = planned.rig.encode()
    found, reason = run(parse(planned.rig), planned.seed, planned.variant, text)
    return Report(found, Verdict.FAILED if found["unstable"] else Verdict.PASSED, reason)


def table(
    rates: Sequence[int], grid: Grid, seeds: range, outcomes: Sequence[Outcome]
) -> list[Series]:
    """A row for each rate and variant, from the outcomes of their plan."""
    made = iter(outcomes)
    return [
        series(variant, rate, [_row(outcome) for outcome in islice(made, len(seeds))])
        for rate in rates
        for variant in grid.variants()
    ]


def figure_plan(rig: str, grid: Grid, stiffness: float, seed: int) -> Plan:
    """Time courses of each law on one and the same surface, as in the paper's Fig. 6.

    rig: its text. stiffness: N/mm.
    """
    variants = [
        replace(grid.variant(law, stiffness, grid.latencies[0]), nominal=True, trace=True)
        for law in grid.laws
    ]
    return _planned(
        Run(f"{__name__}:one", rig, number, variant.as_json())
        for variant in variants
        for number in range(seed, seed + FIGURE_SEEDS)
    )


def courses(grid: Grid, outcomes: Sequence[Outcome]) -> dict[str, list[Row]]:
    """Of the figure's plan, law by law."""
    made = iter(outcomes)
    return {law: [_row(outcome) for outcome in islice(made, FIGURE_SEEDS)] for law in grid.laws}


def _row(outcome: Outcome) -> Row:
    """A run that never came back is neither stable nor unstable."""
    reason = f"{outcome.verdict.value}: {outcome.reason}" if outcome.verdict.broken else ""
    return {
        "unstable": False,
        **outcome.figures,
        "failed": outcome.verdict.broken,
        "ending": reason or outcome.reason,
    }


def _planned(runs: Iterable[Run]) -> Plan:
    return Plan(f"{__name__}:one", tuple(runs), LIMIT, f"{warm_up.__name__}:cell")


def _recorded(variant: Variant, rate: int, out: Path | None) -> Variant:
    if out is None:
        return variant
    law = variant.law.replace(":", ".")
    name = f"{law}_{variant.stiffness / 1e3:g}Npmm_{variant.latency * 1e3:g}ms_{rate}Hz"
    return replace(variant, recording=str((out / "recordings" / name).resolve()))
