"""The whole experiment: a grid, some seeds, one table; and the runs behind the paper's figure."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import islice
from pathlib import Path

from hil.cell.rig import Rig
from hil.experiments.force_tracking.grid import Grid
from hil.experiments.force_tracking.run import Row
from hil.experiments.force_tracking.series import Job, rows
from hil.experiments.force_tracking.table import Series, series
from hil.experiments.force_tracking.variant import Variant

Report = Callable[[Series], None]
FIGURE_SEEDS = 5
"""Runs behind each curve of the figure: as many as the paper's."""


def experiment(
    rigs: dict[int, Rig], grid: Grid, seeds: range, workers: int, out: Path | None
) -> Iterator[Series]:
    """One row a series as it is finished; the first run of each is recorded below `out`."""
    for rate, rig in rigs.items():
        variants = grid.variants()
        jobs = [
            Job(rig, seed, _recorded(variant, rate, out) if seed == seeds[0] else variant)
            for variant in variants
            for seed in seeds
        ]
        results = rows(jobs, workers)
        for variant in variants:
            yield series(variant, rate, list(islice(results, len(seeds))))


def courses(
    rig: Rig, grid: Grid, stiffness: float, seed: int, workers: int
) -> dict[str, list[Row]]:
    """Time courses of each law on one and the same surface, as in the paper's Fig. 6."""
    still = rig.randomisation.model_copy(update={"enabled": False})
    rig = rig.model_copy(update={"randomisation": still})
    variants = [
        replace(grid.variant(law, stiffness, grid.latencies[0]), trace=True) for law in grid.laws
    ]
    seeds = range(seed, seed + FIGURE_SEEDS)
    results = rows([Job(rig, s, variant) for variant in variants for s in seeds], workers)
    return {variant.law: list(islice(results, FIGURE_SEEDS)) for variant in variants}


def _recorded(variant: Variant, rate: int, out: Path | None) -> Variant:
    if out is None:
        return variant
    law = variant.law.replace(":", ".")
    name = f"{law}_{variant.stiffness / 1e3:g}Npmm_{variant.latency * 1e3:g}ms_{rate}Hz"
    return replace(variant, recording=str(out / "recordings" / name))
