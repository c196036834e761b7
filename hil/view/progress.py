"""A line on the terminal while a run goes on: phase, depth, force, speed."""

import sys
from collections.abc import Callable
from time import monotonic
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

INTERVAL = 0.1
"""Wall seconds between updates; drawing takes 1 ms, more than a control period's whole budget."""


class RunProgress:
    """Shows a run on stderr, if that is a terminal and `quiet` is not asked for.

    goal: depth at which the bar is full, m. now: a wall clock, s.
    """

    def __init__(
        self,
        goal: float,
        *,
        quiet: bool = False,
        console: Console | None = None,
        now: Callable[[], float] = monotonic,
    ) -> None:
        self._console = console or Console(file=sys.stderr)
        self._shown = not quiet and self._console.is_terminal
        self._now, self._start, self._due = now, now(), float("-inf")
        self._screen = Progress(
            TextColumn("{task.description:<9}"),
            BarColumn(20),
            TextColumn("{task.fields[state]}"),
            console=self._console,
            auto_refresh=False,  # no thread beside the loop
            transient=True,
        )
        self._task = self._screen.add_task("start", total=goal, state="")

    def update(self, t: int, phase: str, depth: float, f_z: float) -> None:
        """Tell where the run stands at bench time t, ns; draws at most ten times a second."""
        if not self._shown or (now := self._now()) < self._due:
            return
        self._due = now + INTERVAL
        elapsed = max(now - self._start, 1e-9)
        state = f"{t * 1e-9:6.2f} s  depth {depth * 1e3:5.2f} mm  f_z {f_z:6.2f} N"
        speed = f"  {t * 1e-9 / elapsed:5.1f} x real time"
        self._screen.update(
            self._task, description=phase, completed=max(depth, 0.0), state=state + speed
        )
        self._screen.refresh()

    def __enter__(self) -> Self:
        self._start = self._now()
        if self._shown:
            self._screen.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._shown:
            self._screen.stop()
