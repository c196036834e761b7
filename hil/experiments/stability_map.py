"""Which stiffness a force law holds at which latency: a map for each law and control rate.

Made without a wire (`force_tracking.direct`); `experiment` spot-checks it over RTDE and CAN.
"""

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure

from controller.reference import Step
from controller.track import Tracking
from hil.app.process import uninterrupted
from hil.cell.rig import Rig
from hil.experiments.force_tracking.direct import direct
from hil.experiments.force_tracking.grid import Grid
from hil.experiments.force_tracking.run import run
from hil.experiments.force_tracking.variant import Variant

STIFFNESSES = tuple(round(float(k), 2) for k in np.geomspace(0.5, 200.0, 14))
"""k_e, N/mm."""
LATENCIES = (0.0, 2.0, 6.0, 10.0, 16.0, 24.0)
"""Total, ms."""
MOVING = 2.0
"""Seconds of sliding: instability shows within them."""


@dataclass(frozen=True, slots=True)
class Cell:
    """k_e: N/mm. unstable: runs of `runs`. overshoot: worst of the stable runs, share of f_d."""

    law: str
    rate_hz: int
    k_e: float
    latency_ms: float
    runs: int
    unstable: int
    overshoot: float


def stability_map(
    rigs: Mapping[int, Rig], grid: Grid, seeds: range, workers: int
) -> Iterator[Cell]:
    """Every cell of the grid, rate by rate, law by law."""
    jobs = [
        (rate, rig, variant, seeds) for rate, rig in rigs.items() for variant in grid.variants()
    ]
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        with uninterrupted():
            results = pool.map(_cell, *zip(*jobs, strict=True), chunksize=4)
        yield from results


def _cell(rate: int, rig: Rig, variant: Variant, seeds: range) -> Cell:
    job = Tracking(force=Step(variant.force), moving=MOVING)
    made = [direct(rig, seed, variant, job) for seed in seeds]
    stable = [figures.overshoot or 0.0 for figures in made if not figures.unstable]
    return Cell(
        variant.law, rate, variant.stiffness / 1e3, variant.latency * 1e3,
        len(made), len(made) - len(stable), max(stable, default=float("nan")),
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class Check:
    """A cell again, over the wire. agrees: both say stable, or both say not."""

    cell: Cell
    unstable_on_wire: bool
    agrees: bool


def spot_checks(
    rigs: Mapping[int, Rig], grid: Grid, cells: Sequence[Cell], seed: int, count: int
) -> Iterator[Check]:
    """So many cells drawn at random and run over RTDE and CAN."""
    clear = [cell for cell in cells if cell.unstable in (0, cell.runs)]
    rng = np.random.default_rng(seed)
    for index in rng.permutation(len(clear))[:count]:
        cell = clear[int(index)]
        variant = grid.variant(cell.law, cell.k_e, cell.latency_ms)
        figures, _ = run(rigs[cell.rate_hz], seed, variant.as_json())
        unstable = bool(figures["unstable"])
        yield Check(cell, unstable, unstable == (cell.unstable > 0))


COLOURS = ("#2b7a3d", "#8fc98f", "#f2d16b", "#e58a4e", "#b02a30")
LEVELS = (0.0, 0.05, 0.2, 0.5, 1.0, 2.0)
"""Overshoot up to 5 %, 20 %, 50 %, more; the last colour is unstable."""


def draw(cells: Sequence[Cell], path: Path) -> None:
    """One panel a law and rate."""
    laws = list(dict.fromkeys(cell.law for cell in cells))
    rates = list(dict.fromkeys(cell.rate_hz for cell in cells))
    sheet = Figure(figsize=(3.0 * len(laws) + 1.0, 3.0 * len(rates) + 0.9), layout="constrained")
    panels = sheet.subplots(len(rates), len(laws), squeeze=False, sharex=True, sharey=True)
    for row, rate in zip(panels, rates, strict=True):
        for panel, law in zip(row, laws, strict=True):
            chosen = [cell for cell in cells if (cell.law, cell.rate_hz) == (law, rate)]
            _panel(panel, chosen, f"{law}, {rate} Hz")
    for panel in panels[-1]:
        panel.set_xlabel("total latency [ms]")
    for row in panels:
        row[0].set_ylabel("$k_e$ [N/mm]")
    sheet.suptitle(
        "Overshoot: up to 5 %, 20 %, 50 %, more (green to orange); red: unstable. Without a wire"
    )
    sheet.savefig(path, dpi=120)


def _panel(panel: Axes, cells: Sequence[Cell], title: str) -> None:
    stiffnesses = sorted({cell.k_e for cell in cells})
    latencies = sorted({cell.latency_ms for cell in cells})
    colour = np.full((len(stiffnesses), len(latencies)), np.nan)
    for cell in cells:
        worst = 1.5 if cell.unstable else min(cell.overshoot, 0.99)
        colour[stiffnesses.index(cell.k_e), latencies.index(cell.latency_ms)] = worst
    panel.pcolormesh(
        np.arange(len(latencies) + 1), np.arange(len(stiffnesses) + 1), colour,
        cmap=ListedColormap(list(COLOURS)), norm=BoundaryNorm(LEVELS, len(COLOURS)),
        edgecolors="white", lw=0.5,
    )  # fmt: skip
    panel.set_xticks(np.arange(len(latencies)) + 0.5, [f"{value:g}" for value in latencies])
    panel.set_yticks(np.arange(len(stiffnesses)) + 0.5, [f"{value:.3g}" for value in stiffnesses])
    panel.tick_params(labelsize=7)
    panel.set_title(title, fontsize=9)
