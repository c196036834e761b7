"""The paper's Fig. 6: position and force of each law, mean and standard deviation of its runs."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hil.experiments.force_tracking.run import SHOWN, Row
from hil.experiments.force_tracking.trace import Array

BEFORE = 0.6
"""Seconds of free space shown before the first contact."""
START = 193.0
"""x_c(0), mm."""
NAMES = {
    "constant": "IC (Eq. 13)",
    "duan": "common AIC [25-29]",
    "paper": "the paper's AIC",
    "soft": "SOFT",
}


def draw(courses: Mapping[str, Sequence[Row]], force: float, title: str, path: Path) -> None:
    """Write the figure; force: f_d, N."""
    sheet = Figure(figsize=(9, 8), layout="constrained")
    position, full, close = sheet.subplots(3, 1, sharex=True, height_ratios=(1, 1, 1))
    for law, runs in courses.items():
        name = NAMES.get(law, law)
        _band(position, [START + 1e3 * z for z in _aligned(runs, "z")], name)
        for panel in (full, close):
            _band(panel, _aligned(runs, "push"), name)
    for panel in (full, close):
        panel.axhline(force, color="k", ls="--", lw=0.8)
        panel.set_ylabel("force [N]")
    full.set(ylim=(-0.2 * force, 2.5 * force), title="(b) force tracking")
    close.set(
        ylim=(0.9 * force, 1.1 * force), title="the same, within 10 %",
        xlabel="time from the first contact [s]",
    )  # fmt: skip
    position.set(ylabel="$x_c$ [mm]", title="(a) position tracking")
    position.legend(loc="upper right", fontsize=8)
    sheet.suptitle(title)
    sheet.savefig(path, dpi=120)


def _aligned(runs: Sequence[Row], name: str) -> list[Array]:
    """Each run's course, its first contact at the same index; shorter ones end earlier."""
    aligned = []
    for row in runs:
        course = row.get("course")
        if not isinstance(course, dict):
            continue
        touch = next((i for i, push in enumerate(course["push"]) if push > 0.2), None)
        if touch is not None:
            first = touch - round(BEFORE * 1e3 / SHOWN)
            values = np.array(course[name], dtype=float)
            padding = np.full(max(0, -first), np.nan)
            aligned.append(np.concatenate([padding, values[max(0, first) :]]))
    return aligned


def _band(panel: Axes, runs: Sequence[Array], name: str) -> None:
    """Mean and shaded standard deviation for as long as at least half of the runs go on."""
    if not runs:
        return
    length = int(np.median([len(run) for run in runs]))
    table = np.full((len(runs), length), np.nan)
    for line, run in zip(table, runs, strict=True):
        line[: len(run)] = run[:length]
    known = np.isfinite(table).any(axis=0)
    time = np.arange(length)[known] * SHOWN * 1e-3 - BEFORE
    mean, sd = np.nanmean(table[:, known], axis=0), np.nanstd(table[:, known], axis=0)
    (drawn,) = panel.plot(time, mean, lw=1.0, label=name)
    panel.fill_between(time, mean - sd, mean + sd, color=drawn.get_color(), alpha=0.25, lw=0)
