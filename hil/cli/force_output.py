"""What the force-tracking experiment writes: rows, report and the paper's figure."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from hil.experiments.force_tracking.figure import draw
from hil.experiments.force_tracking.grid import Grid
from hil.experiments.force_tracking.report import page
from hil.experiments.force_tracking.run import Row
from hil.experiments.force_tracking.table import Series
from hil.view import tables

FIGURE = "force_tracking.png"


def write(
    out: Path,
    grid: Grid,
    rows: Sequence[Series],
    courses: Mapping[str, Sequence[Row]],
    stiffness: float,
) -> None:
    """Into folder `out`; courses: of the figure, at that stiffness (N/mm)."""
    out.mkdir(parents=True, exist_ok=True)
    content = tables.as_json({"rows": rows})
    (out / "rows.json").write_text(content, encoding="utf-8")
    rate, latency = rows[0].rate_hz, grid.latencies[0]
    title = f"{stiffness:g} N/mm, {latency:g} ms, {rate} Hz, parameters `{grid.preset}`"
    draw(courses, grid.force, title, out / FIGURE)
    report = page(grid, rows) + f"\n![Position and force, {title}]({FIGURE})\n"
    (out / "report.md").write_text(report, encoding="utf-8")
