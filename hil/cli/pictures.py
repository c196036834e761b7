"""Draws a finished run into its folder: a figure, a page around it, a picture of the scene."""

from contextlib import suppress
from importlib.resources import as_file
from pathlib import Path

from controller.course import Course
from controller.cycle import Cycle
from hil.app.cell import RunningCell
from hil.app.inline import InlineCell
from hil.cell.plant.ffc import FfcPlant
from hil.cli.shipped import find
from hil.recording.read import load
from hil.view import scene
from hil.view.page import render
from hil.view.run_figure import draw as figure

MOMENT = "insert"
"""The phase at whose beginning the scene is kept: the tip has just found the slot."""


PICTURES = ("run.png", "run.html", "scene.png")


class Photographer:
    """Keeps the plant's state at one moment of a run, and draws it once the run is over."""

    def __init__(self) -> None:
        self._kept = b""

    def watch(self, _cycle: Cycle, course: Course, cell: RunningCell) -> None:
        if self._kept or course.name != MOMENT or not isinstance(cell, InlineCell):
            return
        plant = cell.served.bench.plant
        if isinstance(plant, FfcPlant):
            self._kept = scene.keep(plant, cell.truth())

    def develop(self, rig: str, picture: Path) -> str:
        """Draw what was kept; the line that says where it is, or why there is none."""
        if not self._kept:
            return "no picture of the scene: the slot was not found"
        with as_file(find(rig)) as rig_file:
            problem = scene.draw(rig_file, self._kept, picture)
        return f"no picture of the scene: {problem}" if problem else f"scene {picture}"


def clear(out: Path) -> None:
    """Take away an earlier run's pictures, which would pass for the next one's."""
    for name in PICTURES:
        with suppress(NotADirectoryError):  # the recorder will say so
            (out / name).unlink(missing_ok=True)


def draw(out: Path) -> list[str]:
    """Write run.png and run.html from the recording in `out`; where they are, a line each."""
    recording = load(out)
    picture = figure(recording)
    (out / "run.png").write_bytes(picture)
    (out / "run.html").write_text(render(recording, picture), encoding="utf-8")
    return [f"figure {out / 'run.png'}", f"page {out / 'run.html'}"]
