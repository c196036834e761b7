"""The cell in a process of its own: only the wires, and a pipe for start, stop and records."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from multiprocessing import get_context, resource_tracker
from multiprocessing.connection import Connection
from typing import Self

from hil.app.cell import CellReport
from hil.app.faulty import Teller, failing, served
from hil.app.tap import Entry, entries, ignore
from hil.cell.errors import CellError
from hil.cell.faults.schedule import Numbered
from hil.cell.injection.cell import InjectedCell
from hil.cell.plant.interface import PlantStep
from hil.cell.rig import Rig
from hil.cell.serve import Doors, Tick

STARTUP = 60.0
"""Wall seconds that a cell may take to open its doors, imports included."""


class CellProcess:
    """Owns a child process that serves the cell; construction waits until its doors are open."""

    live = False

    def __init__(
        self,
        rig: Rig,
        seed: int,
        clock: str,
        *,
        record: bool = True,
        faults: Numbered | None = None,
    ) -> None:
        """faults: those of the cell itself; none is a sound one."""
        context = get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._child = context.Process(
            target=_serve, args=(theirs, rig, seed, clock, record, faults)
        )
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

    def note(self, phase: str, episode: int) -> None:
        """Told before the command; the cell looks here before it takes one, so a run repeats."""
        self._tell("note", phase, episode)

    def leave(self, duration: int) -> None:
        """The host is not there for so long, ns."""
        self._tell("leave", duration)

    def _tell(self, *word: object) -> None:
        try:
            self._pipe.send(word)
        except OSError:
            raise CellError("the cell's process died") from None

    def take(self) -> list[Entry]:
        """Nothing before `stop`; then all records, oldest first."""
        taken, self._entries = self._entries, []
        return taken

    def stop(self) -> CellReport:
        """Stop the process; raises what the cell died of, if it did."""
        try:
            self._pipe.send(("stop",))
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


def _serve(  # noqa: PLR0917  a process's arguments are positional
    pipe: Connection, rig: Rig, seed: int, clock: str, record: bool, faults: Numbered | None
) -> None:
    """The child's main: serve until told to stop or until the parent is gone."""
    from hil.app.pacing import pace  # noqa: PLC0415  MuJoCo loads only with a cell

    kept: list[Entry] = []
    try:
        with served(rig, seed, faults, across_processes=True) as cell:
            pipe.send((cell.doors, cell.describe()))
            teller = None if faults is None else Teller(cell)
            observe = _keeper(kept, teller) if record else ignore
            stopped = pipe.poll if faults is None else _Ear(pipe, failing(cell)).stopped
            report = pace(cell, clock, stopped, observe)
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


class _Ear:
    """Does what the parent tells a failing cell; remembers that it was told to stop."""

    def __init__(self, pipe: Connection, cell: InjectedCell) -> None:
        self._pipe, self._stop = pipe, False
        self._do: dict[str, Callable[..., None]] = {"note": cell.note, "leave": cell.leave}
        cell.listen(self.hear)

    def stopped(self) -> bool:
        self.hear()
        return self._stop

    def hear(self) -> None:
        while not self._stop and self._pipe.poll():
            word, *arguments = self._pipe.recv()
            if word == "stop":
                self._stop = True
            else:
                self._do[word](*arguments)


def _keeper(kept: list[Entry], teller: Teller | None) -> Callable[[Tick], None]:
    if teller is None:
        return lambda tick: kept.extend(entries(tick))
    return lambda tick: kept.extend([*entries(tick), *teller(tick.t)])
