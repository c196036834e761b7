"""A run's forces and depth over time, after the paper's Fig. 11."""

from io import BytesIO
from itertools import cycle
from typing import Literal

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from hil.cell.errors import RigError
from hil.cell.rig import Rig, parse
from hil.recording import series
from hil.recording.read import Recording
from hil.recording.series import Control, Truth
from hil.recording.summary import summarise
from hil.view.window import Window, assembly, phases, true_normal_force

BANDS = ("#f3f5f8", "#e3e8ef")
BLUE, ORANGE, GREEN, GREY, RED = "#1f5fa8", "#d9731a", "#2a8a4a", "#b4b8bf", "#b3261e"
LABEL = 0.035
"""Phases shorter than this share of the width get no name: it would not fit."""


def draw(recording: Recording) -> bytes:
    """PNG of the assembly: normal force, lateral forces, depth, with phases and the slot marked."""
    controller, plant = series.control(recording), series.truth(recording)
    window, rig = assembly(controller, plant), _rig(recording)
    figure = Figure(figsize=(10, 8), layout="constrained")
    FigureCanvasAgg(figure)
    normal, lateral, depth = figure.subplots(3, 1, sharex=True, height_ratios=(3, 2, 2))
    _normal(normal, controller, plant, window, rig)
    _lateral(lateral, controller, window, rig)
    _depth(depth, controller, plant, window, rig)
    for axes in (normal, lateral, depth):
        _mark_phases(axes, controller, window, named=axes is normal)
        axes.margins(x=0)
        axes.grid(visible=True, color="white", linewidth=0.8)
    summary = summarise(recording)
    if summary.slot_found is not None:
        _mark_slot((normal, lateral, depth), summary.slot_found)
    depth.set_xlabel("bench time / s")
    outcome = summary.outcome or summary.ending or "no outcome recorded"
    figure.suptitle(
        f"{summary.rig}, seed {summary.seed}: {outcome}", fontsize=11, x=0.01, ha="left"
    )
    return _png(figure)


def _normal(axes: Axes, controller: Control, plant: Truth, window: Window, rig: Rig | None) -> None:
    shown = window.holds(controller.t)
    t_true, f_true = true_normal_force(plant, window)
    axes.plot(t_true, f_true, color=GREY, linewidth=0.6, label="$f_z$ true, 1 kHz")
    axes.plot(
        controller.t[shown], controller.wrench[shown, 2], color=BLUE, linewidth=1.3,
        label="$f_z$ measured, period mean",
    )  # fmt: skip
    if rig:
        desired, bound = rig.task.contact_force, rig.limits.force_bound[2]
        axes.axhline(desired, color="black", linestyle=":", label=f"$f_d$ = {desired:g} N")
        axes.axhline(bound, color=RED, linestyle="--", label=f"$f_b$ = {bound:g} N")
    axes.set_ylabel("normal force / N")
    _legend(axes, "upper left")


def _lateral(axes: Axes, controller: Control, window: Window, rig: Rig | None) -> None:
    shown = window.holds(controller.t)
    t = controller.t[shown]
    for column, name, colour in ((0, "$f_x$", BLUE), (1, "$f_y$", ORANGE)):
        axes.plot(t, controller.wrench[shown, column], color=colour, linewidth=1.1, label=name)
    if rig:
        bound = rig.limits.force_bound[0]
        axes.axhline(bound, color=RED, linestyle="--", label=f"$f_b$ = {bound:g} N")
        axes.axhline(-bound, color=RED, linestyle="--")
    axes.set_ylabel("lateral force / N")
    _legend(axes, "upper left")


def _depth(axes: Axes, controller: Control, plant: Truth, window: Window, rig: Rig | None) -> None:
    """Gripper and tip in one plot: where they part, the cable bends."""
    shown, known = window.holds(controller.t), window.holds(plant.t)
    axes.plot(
        controller.t[shown], controller.stage[shown, 2] * 1e3, color=GREEN, linewidth=1.1,
        label="gripper $z$, reported",
    )  # fmt: skip
    axes.plot(
        plant.t[known], plant.tip[known, 2] * 1e3, color=BLUE, linewidth=1.3, label="tip $z$, true"
    )
    if rig:
        goal = -rig.task.goal_depth * 1e3
        axes.axhline(goal, color="black", linestyle=":", label=f"goal = {goal:g} mm")
    axes.set_ylabel("above the face / mm")
    _legend(axes, "upper right")


def _legend(axes: Axes, place: Literal["upper left", "upper right"]) -> None:
    """One row above the curves."""
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.18 * (high - low))
    axes.legend(loc=place, ncols=4, fontsize=8, framealpha=0.9)


def _mark_phases(axes: Axes, controller: Control, window: Window, *, named: bool) -> None:
    width = max(window.end - window.start, 1e-9)
    for span, colour in zip(phases(controller, window), cycle(BANDS), strict=False):
        axes.axvspan(span.start, span.end, color=colour, zorder=0, linewidth=0)
        if named and (span.end - span.start) / width > LABEL:
            middle = (span.start + span.end) / 2
            axes.text(
                middle, 1.01, span.name, transform=axes.get_xaxis_transform(), ha="center",
                va="bottom", fontsize=8, color="#555b66",
            )  # fmt: skip


def _mark_slot(panels: tuple[Axes, ...], t: float) -> None:
    for axes in panels:
        axes.axvline(t, color=ORANGE, linewidth=1.0)
    panels[0].annotate(
        "slot found", (t, 0.66), xycoords=panels[0].get_xaxis_transform(), xytext=(4, 2),
        textcoords="offset points", fontsize=8, color=ORANGE,
    )  # fmt: skip


def _rig(recording: Recording) -> Rig | None:
    """The rig that the recording carries, for its limits; None when it is not readable now."""
    try:
        return parse(recording.attachments.get("rig.yaml", b"").decode())
    except RigError:
        return None


def _png(figure: Figure) -> bytes:
    """The picture without matplotlib's version in it: the same run gives the same picture."""
    picture = BytesIO()
    figure.savefig(picture, format="png", dpi=110, metadata={"Software": None})
    return picture.getvalue()
