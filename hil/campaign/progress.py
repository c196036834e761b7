"""A line on the terminal while a campaign goes on: runs done, what broke, how long it will take."""

import sys
from collections import Counter
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from hil.campaign.run import Outcome, Run, Verdict


class CampaignProgress:
    """Shows a campaign of `total` runs on stderr, if that is a terminal and not `quiet`."""

    def __init__(self, total: int, *, quiet: bool = False, console: Console | None = None) -> None:
        self._console = console or Console(file=sys.stderr)
        self._shown = not quiet and self._console.is_terminal
        self._verdicts: Counter[Verdict] = Counter()
        self._screen = Progress(
            MofNCompleteColumn(),
            BarColumn(20),
            TimeRemainingColumn(elapsed_when_finished=True),
            TextColumn("{task.fields[verdicts]}"),
            console=self._console,
            auto_refresh=False,
            transient=True,
        )
        self._task = self._screen.add_task("", total=total, verdicts="")

    @property
    def done(self) -> int:
        return self._verdicts.total()

    def update(self, run: Run, outcome: Outcome) -> None:
        """A run has ended."""
        self._verdicts[outcome.verdict] += 1
        if self._shown:
            counts = ", ".join(f"{verdict} {n}" for verdict, n in sorted(self._verdicts.items()))
            self._screen.update(self._task, completed=self.done, verdicts=counts)
            self._screen.refresh()

    def __enter__(self) -> Self:
        if self._shown:
            self._screen.start()
            self._screen.refresh()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._shown:
            self._screen.stop()
