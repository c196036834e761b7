"""Fig. 4: steps of each episode, mean over the seeds with its 95 % interval."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hil.cell.streams import stream
from hil.experiments.ffc.rows import steps
from hil.experiments.ffc.runs import Training
from hil.experiments.statistics import spread


def draw(trainings: Sequence[Training], title: str, path: Path) -> None:
    """Write the figure; those with n agents are dashed."""
    sheet = Figure(figsize=(9, 5.5), layout="constrained")
    panel = sheet.subplots()
    for name in dict.fromkeys(training.learner for training in trainings):
        runs = [steps(t.episodes) for t in trainings if t.learner == name and not t.broken]
        if runs:
            _curve(panel, np.array(runs), name)
    panel.set(xlabel="episode", ylabel="steps", yscale="log", title=title)
    panel.grid(alpha=0.3)
    panel.legend(fontsize=8, ncols=2)
    sheet.savefig(path, dpi=120)


def _curve(
    panel: Axes, runs: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]", name: str
) -> None:
    ends = [spread(column, stream(0, "bootstrap"), np.mean) for column in runs.T]
    episodes = np.arange(1, runs.shape[1] + 1)
    style = "--" if "n=" in name else "-"
    (drawn,) = panel.plot(episodes, runs.mean(axis=0), style, lw=1.2, label=name)
    low, high = ([end[side] for end in ends] for side in (0, 1))
    panel.fill_between(episodes, low, high, color=drawn.get_color(), alpha=0.15, lw=0)
