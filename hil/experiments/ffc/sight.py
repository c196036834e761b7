"""What the figures show of one training besides its episodes: forces of one, and the policy."""

from collections.abc import Sequence
from dataclasses import dataclass

from controller.course import Course
from controller.cycle import Cycle
from controller.outcome import Kind
from hil.app.cell import RunningCell
from hil.app.train import EpisodeResult
from learner.surface import Array

PHASES = frozenset(("contact", "search", "insert", "draw out"))


@dataclass(frozen=True, slots=True)
class Sight:
    """force: t (s), fx, fy, fz (N, 8 ms means), z (m) of each period of the last inserted episode
    with the first part. surface: the final policy's worth over x and y, empty where it has none.
    """

    force: Sequence[tuple[float, float, float, float, float]]
    surface: Sequence[Sequence[float]]


class Watcher:
    """Keeps the forces of an episode until it is known how that ended."""

    def __init__(self) -> None:
        self._part = ""
        self._now: list[tuple[float, float, float, float, float]] = []
        self._kept: list[tuple[float, float, float, float, float]] = []

    def watch(self, cycle: Cycle, course: Course, _cell: RunningCell) -> None:
        if course.name == "approach":
            self._now.clear()
        elif course.name in PHASES:
            fx, fy, fz = (round(value, 3) for value in cycle.wrench[:3])
            self._now.append((round(cycle.t * 1e-9, 3), fx, fy, fz, round(cycle.stage.z, 6)))

    def ended(self, result: EpisodeResult) -> None:
        """The episode that was just watched came to this."""
        self._part = self._part or result.part
        if result.part == self._part and result.kind is Kind.INSERTED:
            self._kept = self._now.copy()

    def sight(self, surface: Array | None) -> Sight:
        rows = [] if surface is None else [[float(v) for v in row] for row in surface]
        return Sight(self._kept, rows)
