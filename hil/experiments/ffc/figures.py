"""Figs. 9 to 12 of the paper from a series of trainings."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from controller.outcome import Kind
from hil.cell.streams import stream
from hil.experiments.ffc.rows import share, steps
from hil.experiments.ffc.runs import Training
from hil.experiments.statistics import spread

KINDS = {Kind.INSERTED: ("success", "#2a8a4a"), Kind.DANGER: ("force bound", "#b3261e"),
         Kind.LIMIT: ("step limit", "#d9a21a")}  # fmt: skip
PAPER = {"paper's wdql": (92, 6, 2), "paper's ql": (74, 20, 6)}
"""Percent of one run of 50 episodes."""
BLUE, ORANGE, GREY = "#1f5fa8", "#d9731a", "#777d87"

Groups = Mapping[str, Sequence[Training]]


def groups(trainings: Sequence[Training]) -> Groups:
    """Whole runs by learner, in the order in which they first appear."""
    names = dict.fromkeys(training.learner for training in trainings)
    found = {name: [t for t in trainings if t.learner == name and not t.broken] for name in names}
    return {name: runs for name, runs in found.items() if runs}


def draw(found: Groups, folder: Path) -> list[Path]:
    """Write every figure there is something for; their paths."""
    pictures = {
        "fig9.png": _rates(found),
        "fig10.png": _steps(found),
        "fig11.png": _force(found),
        "fig12.png": _policy(found),
    }
    drawn = []
    for name, sheet in pictures.items():
        if sheet is not None:
            sheet.savefig(folder / name, dpi=110)
            drawn.append(folder / name)
    return drawn


def _rates(found: Groups) -> Figure:
    """Fig. 9: how episodes ended, in all and by episode."""
    sheet = Figure(figsize=(10, 3.2 + 0.9 * len(found)), layout="constrained")
    whole, *each = sheet.subplots(1 + len(found), 1, height_ratios=[2, *[1] * len(found)])
    bars = {name: [100 * _mean_share(runs, kind) for kind in KINDS] for name, runs in found.items()}
    bars |= {name: [float(rate) for rate in rates] for name, rates in PAPER.items()}
    left = np.zeros(len(bars))
    for index, (label, colour) in enumerate(KINDS.values()):
        widths = np.array([rates[index] for rates in bars.values()])
        drawn = whole.barh(list(bars), widths, left=left, color=colour, label=label)
        whole.bar_label(drawn, [f"{w:.3g}" if w >= 3 else "" for w in widths],
                        label_type="center", color="white", fontsize=8)  # fmt: skip
        left += widths
    whole.invert_yaxis()
    whole.set(xlim=(0, 100), title="(a) share of all episodes [%]")
    whole.legend(fontsize=8, ncols=3, loc="upper center", bbox_to_anchor=(0.5, -0.12))
    for panel, (name, runs) in zip(each, found.items(), strict=True):
        _failures(panel, name, runs)
    if each:
        each[0].set_title("(b) failed runs by episode [%]")
        each[-1].set_xlabel("episode")
    return sheet


def _mean_share(runs: Sequence[Training], kind: Kind) -> float:
    return float(np.mean([share(run.episodes, kind) for run in runs]))


def _failures(panel: Axes, name: str, runs: Sequence[Training]) -> None:
    length = min(len(run.episodes) for run in runs)
    at, bottom = np.arange(1, length + 1), np.zeros(length)
    for kind in (Kind.DANGER, Kind.LIMIT):
        rate = np.array([
            100 * np.mean([run.episodes[i].kind is kind for run in runs]) for i in range(length)
        ])  # fmt: skip
        panel.bar(at, rate, bottom=bottom, color=KINDS[kind][1], width=0.9)
        bottom += rate
    panel.set(xlim=(0, length + 1), ylim=(0, max(20.0, 1.1 * float(bottom.max()))), ylabel=name)


def _steps(found: Groups) -> Figure:
    """Fig. 10: steps by episode with the mean's interval; execution times."""
    sheet = Figure(figsize=(10, 4.2), layout="constrained")
    by_episode, times = sheet.subplots(1, 2, width_ratios=(3, 2))
    for name, runs in found.items():
        length = min(len(run.episodes) for run in runs)
        table = np.array([steps(run.episodes[:length]) for run in runs])
        ends = [spread(column, stream(0, "bootstrap"), np.mean) for column in table.T]
        at = np.arange(1, length + 1)
        (line,) = by_episode.plot(at, table.mean(axis=0), lw=1.3, label=f"{name}, n = {len(runs)}")
        low, high = ([end[side] for end in ends] for side in (0, 1))
        by_episode.fill_between(at, low, high, color=line.get_color(), alpha=0.2, lw=0)
    by_episode.axhline(20, color=GREY, ls=":", lw=1, label="paper: about 20")
    by_episode.set(
        xlabel="episode", ylabel="steps", yscale="log", title="(a) mean of the runs, 95 % interval"
    )
    by_episode.legend(fontsize=8)
    by_episode.grid(alpha=0.3)
    seconds = [[e.seconds for run in runs for e in run.episodes] for runs in found.values()]
    times.boxplot(seconds, orientation="horizontal", tick_labels=list(found), showfliers=False)
    times.set(xlabel="bench time of an episode [s]", title="(b) execution time")
    times.invert_yaxis()
    times.grid(alpha=0.3)
    return sheet


def _force(found: Groups) -> Figure | None:
    """Fig. 11: forces and depth of one episode."""
    shown = [(name, run) for name, runs in found.items() for run in runs if _has_force(run)]
    if not shown:
        return None
    name, run = shown[0]
    assert run.sight is not None, "chosen for its forces"
    t, fx, fy, fz, z = np.array(run.sight.force).T
    sheet = Figure(figsize=(10, 5), layout="constrained")
    force, depth = sheet.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    for values, label, colour in ((fz, "$f_z$", BLUE), (fx, "$f_x$", ORANGE), (fy, "$f_y$", GREY)):
        force.plot(t - t[0], values, lw=1.2, label=label, color=colour)
    force.set(
        ylabel="8 ms mean [N]", title=f"contact force of one episode: {name}, seed {run.seed}"
    )
    force.legend(fontsize=8)
    depth.plot(t - t[0], 1e3 * z, lw=1.2, color="#2a8a4a")
    depth.set(xlabel="bench time since the descent began [s]", ylabel="gripper z [mm]")
    for panel in (force, depth):
        panel.grid(alpha=0.3)
    return sheet


def _has_force(run: Training) -> bool:
    return run.sight is not None and len(run.sight.force) > 0


def _policy(found: Groups) -> Figure | None:
    """Fig. 12: the final policy of each learner's first run that has one."""
    shown = {
        name: np.array(run.sight.surface)
        for name, runs in found.items()
        for run in runs[:1]
        if run.sight is not None and len(run.sight.surface)
    }
    if not shown:
        return None
    sheet = Figure(figsize=(5 * len(shown), 4.4), layout="constrained")
    panels = np.atleast_1d(sheet.subplots(1, len(shown)))
    for panel, (name, values) in zip(panels, shown.items(), strict=True):
        worth(panel, values, name)
    return sheet


def worth(
    panel: Axes, values: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]", name: str
) -> None:
    """Worth over the search box, the start in its middle; the agent moves to bright colours."""
    nx, ny = values.shape
    x, y = (0.3 * (np.arange(n) - n // 2) for n in (nx, ny))
    shades = panel.contourf(x, y, values.T, 24, cmap="viridis")
    panel.figure.colorbar(shades, ax=panel, shrink=0.8, label="largest worth over theta")
    panel.plot(0, 0, "wo", ms=7, mec="k", label="start")
    panel.set(xlabel="x [mm]", ylabel="y [mm]", title=name, aspect="equal")
    panel.legend(fontsize=8)
