"""One cell's faults and those who carry them out, in step with its control periods."""

from collections.abc import Callable
from typing import Protocol, TypeAlias

from hil.cell.faults.injector import Injector, Running
from hil.cell.faults.log import FaultEvent
from hil.cell.faults.situation import Situation

Do: TypeAlias = Callable[[Running, int], None]
"""What to do to a device for one fault at bench time, ns."""


class Act(Protocol):
    """Someone who carries out faults; called in every period, before and after it, at t in ns."""

    def before(self, t: int) -> None: ...
    def after(self, t: int) -> None: ...


class Injection:
    """phase, episode: where the job stands, as its loop said last; it is told out of band.

    hear: takes what was said, for whoever is about to rely on it.
    """

    def __init__(self, injector: Injector) -> None:
        self._injector = injector
        self._acts: list[Act] = []
        self.phase, self.episode = "start", 0
        self.hear: Callable[[], None] = lambda: None

    def of(self, kind: str) -> tuple[Running, ...]:
        """The faults of this row that are in force now."""
        return self._injector.of(kind)

    def add(self, *acts: Act) -> None:
        self._acts += acts

    def note(self, phase: str, episode: int) -> None:
        """Where the job stands, before the command that lets the cell move on."""
        self.phase, self.episode = phase, episode

    def before(self, situation: Situation) -> None:
        """Begin a period: what is due comes into force."""
        self.hear()
        self._injector.look(situation._replace(phase=self.phase, episode=self.episode))
        for act in self._acts:
            act.before(situation.t)

    def after(self, t: int) -> None:
        """End a period at t, ns."""
        for act in self._acts:
            act.after(t)
        self._injector.settle(t)

    def events(self, t: int) -> tuple[FaultEvent, ...]:
        """What became of the faults by t, ns."""
        self._injector.settle(t)
        return self._injector.events


class Switch:
    """Calls `on` for each fault of a row that comes into force, and `off` when it is over."""

    def __init__(
        self, injection: Injection, kind: str, on: Do, off: Callable[[], None] | None = None
    ) -> None:
        self._injection, self._kind, self._on, self._off = injection, kind, on, off
        self._running: tuple[Running, ...] = ()

    def before(self, t: int) -> None:
        now = self._injection.of(self._kind)
        if self._off is not None and any(one not in now for one in self._running):
            self._off()
        for one in now:
            if one not in self._running:
                self._on(one, t)
        self._running = now

    def after(self, t: int) -> None:
        """Nothing: what was switched stays so."""
