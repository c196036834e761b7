"""The cell in a process of its own: only the wires, and a pipe for start, stop and records."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from multiprocessing import get_context, resource_tracker
from multiprocessing.connection import Connection
from typing import Self

from hil.app.cell import CellReport
from hil.app.tap import Entry, entries, ignore
from hil.cell.errors import CellError
from hil.cell.plant.interface import PlantStep
from hil.cell.rig import Rig
from hil.cell.serve import Doors, Tick

STARTUP = 60.0
"""Wall seconds that a cell may take to open its doors, imports included."""


class CellProcess:
    """Owns a child process that serves the cell; construction waits until its doors are open."""

    live = False

    def __init__(self, rig: Rig, seed: int, clock: str, *, record: bool = True) -> None:
        context = get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._child = context.Process(target=_serve, args=(theirs, rig, seed, clock, record))
        with uninterrupted():
            self._child.start()
        theirs.close()
        self._entries: list[Entry] = []
        self._doors, self._description = self._first_word()

    def _first_word(self) -> tuple[Doors, str]:
        try:
            if not self._pipe.poll(STARTUP):
                raise CellError(f"the cell's process did not open its doors within {STARTUP:g} s")
            word = self._pipe.recv()
        except EOFError:
            self._end()
            raise CellError("the cell's process ended before its doors were open") from None
        if isinstance(word, BaseException):
            self._end()
            raise word
        doors, description = word
        return doors, description

    @property
    def doors(self) -> Doors:
        return self._doors

    @property
    def description(self) -> str:
        return f"cell in its own process, {self._description}"

    def truth(self) -> PlantStep:
        """Not to be had: the truth stays in the cell's process until it stops."""
        raise CellError("the plant's truth is at hand only with the cell in this process")

    def take(self) -> list[Entry]:
        """Nothing before `stop`; then all records, oldest first."""
        taken, self._entries = self._entries, []
        return taken

    def stop(self) -> CellReport:
        """Stop the process; raises what the cell died of, if it did."""
        try:
            self._pipe.send("stop")
            word = self._pipe.recv()
        except (EOFError, OSError):
            self._end()
            raise CellError("the cell's process died") from None
        self._end()
        if isinstance(word, BaseException):
            raise word
        report: CellReport
        report, self._entries = word
        return report

    def _end(self) -> None:
        self._pipe.close()
        self._child.join(STARTUP)
        if self._child.is_alive():
            self._child.kill()
            self._child.join()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._child.is_alive():
            self._end()


def _serve(pipe: Connection, rig: Rig, seed: int, clock: str, record: bool) -> None:
    """The child's main: serve until told to stop or until the parent is gone."""
    from hil.app.pacing import pace  # noqa: PLC0415  MuJoCo loads only with a cell
    from hil.cell.assemble import serve  # noqa: PLC0415

    kept: list[Entry] = []
    try:
        with serve(rig, seed, across_processes=True) as cell:
            pipe.send((cell.doors, cell.describe()))
            observe = _keeper(kept) if record else ignore
            report = pace(cell, clock, pipe.poll, observe)
        word: object = (report, kept)
    except Exception as error:
        word = error
    with suppress(BrokenPipeError):  # the parent gave up or died, and wants no records
        pipe.send(word)


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Children started here never see SIGINT: a terminal sends it to all, the parent ends them."""
    resource_tracker.ensure_running()  # else the first start would, and unblock SIGINT
    before = signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT,))
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _keeper(kept: list[Entry]) -> Callable[[Tick], None]:
    return lambda tick: kept.extend(entries(tick))
