"""One run's faults: told the situation once a period, asked by the places what is in force."""

from typing import Final

import numpy as np

from hil.cell.faults.log import FaultEvent, Stage
from hil.cell.faults.schedule import Fault, Numbered
from hil.cell.faults.situation import Situation
from hil.cell.faults.trigger import Watch
from hil.cell.streams import stream

FOREVER: Final = 1 << 62


class Running:
    """One fault in force from `since` to `until`, ns; its place calls `felt` at each effect."""

    def __init__(self, fault: Fault, index: int, since: int, until: int, seed: int) -> None:
        self.fault, self.index, self.since, self.until = fault, index, since, until
        self.effect: tuple[int, str] | None = None
        self.spent = self.told = False
        self._seed = seed

    def felt(self, t: int, detail: str = "") -> None:
        """The fault had an effect at its place at t, ns; the first one is what counts."""
        if self.effect is None:
            self.effect = (t, detail)

    def done(self, t: int, detail: str = "") -> None:
        """It happened, and that was all of it."""
        self.felt(t, detail)
        self.spent = True

    def draws(self, t: int) -> np.random.Generator:
        """Dice of this fault at t, ns: what they show depends on seed, fault and t alone."""
        return stream(self._seed, f"fault.{self.index}.{self.fault.kind}.{t}")


class Injector:
    """Faults that are not this end's are left out, and keep their numbers.

    seed: of the run. period: ns.
    """

    def __init__(self, faults: Numbered, seed: int, period: int) -> None:
        self._seed, self._period = seed, period
        self._faults = dict(faults)
        self._watches = {
            index: Watch(fault.trigger, period, stream(seed, f"fault.{index}.trigger"))
            for index, fault in self._faults.items()
        }
        self._running: list[Running] = []
        self._events = [
            FaultEvent(0, index, fault.kind, Stage.ARMED, str(fault.trigger))
            for index, fault in self._faults.items()
        ]
        self._active: set[str] = set()
        self._cleared: set[str] = set()

    def look(self, now: Situation) -> None:
        """Begin what is due and end what is over, at the beginning of the period at now.t, ns."""
        self.settle(now.t)
        seen = now._replace(active=frozenset(self._active), cleared=frozenset(self._cleared))
        for index, watch in self._watches.items():
            if watch.fires(seen) and not any(one.index == index for one in self._running):
                self._running.append(self._begun(index, now.t))

    def settle(self, t: int) -> None:
        """Log what was felt by t, ns, and end what is over."""
        for one in self._running:
            if one.effect is not None and not one.told:
                one.told = True
                self._active.add(one.fault.kind)
                at, detail = one.effect
                self._note(at, one, Stage.ACTIVE, detail)
        for one in tuple(self._running):
            if one.spent or t >= one.until:
                self._running.remove(one)
                self._active.discard(one.fault.kind)
                self._cleared.add(one.fault.kind)
                self._note(t, one, Stage.CLEARED, "" if one.effect else "without an effect")

    def of(self, kind: str) -> tuple[Running, ...]:
        """The faults of this row that are in force now."""
        return tuple(one for one in self._running if one.fault.kind == kind and not one.spent)

    @property
    def kinds(self) -> frozenset[str]:
        """Ids of all the faults of this run."""
        return frozenset(fault.kind for fault in self._faults.values())

    @property
    def events(self) -> tuple[FaultEvent, ...]:
        """What happened so far, in order."""
        return tuple(self._events)

    def _begun(self, index: int, t: int) -> Running:
        fault = self._faults[index]
        lasts = fault.duration
        until = FOREVER if lasts is None else t + lasts.long(self._period)
        return Running(fault, index, t, until, self._seed)

    def _note(self, t: int, one: Running, stage: Stage, detail: str) -> None:
        self._events.append(FaultEvent(t, one.index, one.fault.kind, stage, detail))
