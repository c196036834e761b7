"""Serve a rig's cell in this thread until somebody says stop."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from hil.app.cell import CellReport
from hil.app.pacing import pace
from hil.app.tap import ignore
from hil.cell.rig import Rig
from hil.cell.serve import Doors

Announce = Callable[[Doors, str], None]
"""Told once where the cell can be reached, and a line about its bus."""


def up(rig: Rig, seed: int, clock: str, announce: Announce) -> CellReport:
    """Open the doors, announce them, run until SIGINT or SIGTERM; raises DoorError."""
    from hil.cell.assemble import serve  # noqa: PLC0415  MuJoCo loads only with a cell

    with _stop_flag() as stopped, serve(rig, seed, across_processes=True) as cell:
        announce(cell.doors, cell.describe())
        return pace(cell, clock, stopped, ignore)


@contextmanager
def _stop_flag() -> Iterator[Callable[[], bool]]:
    """A flag that SIGINT and SIGTERM raise, so that a period is never cut in two."""
    signals: list[int] = []

    def note(number: int, _frame: FrameType | None) -> None:
        signals.append(number)

    before = {number: signal.signal(number, note) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield lambda: bool(signals)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
