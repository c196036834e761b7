"""What the force-tracking experiment writes: rows, report and the paper's figure."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from hil.cell.rig import Rig
from hil.experiments.force_tracking.experiment import courses
from hil.experiments.force_tracking.figure import draw
from hil.experiments.force_tracking.grid import Grid
from hil.experiments.force_tracking.report import page
from hil.experiments.force_tracking.table import Series
from hil.view import tables

FIGURE = "force_tracking.png"


def write(
    out: Path,
    grid: Grid,
    rigs: Mapping[int, Rig],
    rows: Sequence[Series],
    stiffness: float,
    seed: int,
    workers: int,
) -> None:
    """Into folder `out`; the figure's own runs are made now. stiffness: of the figure, N/mm."""
    out.mkdir(parents=True, exist_ok=True)
    content = tables.as_json({"rows": rows})
    (out / "rows.json").write_text(content, encoding="utf-8")
    rate, rig = next(iter(rigs.items()))
    runs = courses(rig, grid, stiffness, seed, workers)
    title = f"{stiffness:g} N/mm, {grid.latencies[0]:g} ms, {rate} Hz, parameters `{grid.preset}`"
    draw(runs, grid.force, title, out / FIGURE)
    report = page(grid, rows) + f"\n![Position and force, {title}]({FIGURE})\n"
    (out / "report.md").write_text(report, encoding="utf-8")
