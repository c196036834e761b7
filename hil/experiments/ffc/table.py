"""The rows as text: each figure with its interval, the paper's own beside them."""

from collections.abc import Sequence
from io import StringIO

from rich.console import Console
from rich.table import Table

from hil.experiments.ffc.rows import Estimate, Row

PAPER = ("paper's wdql", "1", "92", "6", "2", "-", "15", "~20", "~30", "-")
"""Section 4.3: one run of 50 episodes, its figures without intervals."""


def as_text(rows: Sequence[Row], *, paper: bool = True) -> str:
    """A line a learner, rates in %; `paper` adds its own figures."""
    table = Table(box=None, pad_edge=False, header_style="")
    for name in (
        "learner", "seeds", "success", "danger", "limit", "training steps", "quick from episode",
        "late steps", "FFC2 first, mean", "FFC2 first, IQM",
    ):  # fmt: skip
        table.add_column(name, overflow="fold")
    for row in rows:
        seeds = f"{row.seeds}" + (f" ({row.broken} broken)" if row.broken else "")
        rates = (shown(rate, 100.0) for rate in (row.success, row.danger, row.step_limit))
        others = (
            row.training_steps, row.episodes_to_20_steps, row.late_steps,
            row.ffc2_first_steps_mean, row.ffc2_first_steps_iqm,
        )  # fmt: skip
        table.add_row(row.learner, seeds, *rates, *map(shown, others))
    if paper:
        table.add_row(*PAPER)
    screen = StringIO()
    Console(file=screen, width=160, color_system=None, highlight=False, markup=False).print(table)
    return "\n".join(line.rstrip() for line in screen.getvalue().splitlines()) + "\n"


def shown(estimate: Estimate, factor: float = 1.0, unit: str = "") -> str:
    """A figure with its interval; factor: 100 for %."""
    value, low, high = (factor * end for end in (estimate.value, estimate.low, estimate.high))
    return f"{value:.3g}{unit} [{low:.3g}, {high:.3g}]"
