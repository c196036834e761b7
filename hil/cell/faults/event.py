"""Events that a trigger waits for: what they are called, and when they hold."""

import re
from collections.abc import Callable, Mapping
from difflib import get_close_matches
from enum import StrEnum
from typing import Final, NamedTuple

from drivers.protocol.rtde_states import SafetyMode
from hil.cell.errors import FaultError
from hil.cell.faults.catalogue import row
from hil.cell.faults.row import Phase, phase_of
from hil.cell.faults.situation import Situation
from hil.cell.rig import quantity

STATES: Final = tuple(mode.name.lower() for mode in SafetyMode)
JOB_PHASES: Final = ("start", "pick up", "put down", "tare", "draw out", "release")
"""A job's own names that are not names of phases too."""
PHASES: Final = (*Phase, *JOB_PHASES)
_WRITTEN: Final = re.compile(r"\s*([a-z]+)\s*(?:(:|>=|>)\s*(.+?)\s*)?")
FORMS: Final = (
    "contact, phase: insert, force > 5 N, episode >= 3, state: protective_stop, active: C1, "
    "cleared: C1"
)


class Kind(StrEnum):
    CONTACT = "contact"
    PHASE = "phase"
    FORCE = "force"
    EPISODE = "episode"
    STATE = "state"
    ACTIVE = "active"
    CLEARED = "cleared"


class Event(NamedTuple):
    """name: of the phase, state or fault. value: bound on force (N) or episode."""

    kind: Kind
    name: str = ""
    value: float = 0.0

    def holds(self, situation: Situation) -> bool:
        return _HOLDS[self.kind](self, situation)

    def __str__(self) -> str:
        if self.kind is Kind.CONTACT:
            return "contact"
        if self.kind is Kind.FORCE:
            return f"force > {self.value!r} N"
        if self.kind is Kind.EPISODE:
            return f"episode >= {self.value:g}"
        return f"{self.kind}: {self.name}"


_HOLDS: Final[Mapping[Kind, Callable[[Event, Situation], bool]]] = {
    Kind.CONTACT: lambda _, now: now.contact,
    Kind.PHASE: lambda event, now: event.name in (now.phase, phase_of(now.phase)),
    Kind.FORCE: lambda event, now: now.force > event.value,
    Kind.EPISODE: lambda event, now: now.episode >= event.value,
    Kind.STATE: lambda event, now: now.safety == event.name,
    Kind.ACTIVE: lambda event, now: event.name in now.active,
    Kind.CLEARED: lambda event, now: event.name in now.cleared,
}


def event(key: str, text: object) -> Event:
    """Parse it; FaultError names `key`, what was found and what is allowed."""
    found = _WRITTEN.fullmatch(text) if isinstance(text, str) else None
    if found is None or found[1] not in set(Kind):
        words = list(Kind)
        near = get_close_matches(found[1] if found else str(text), words, n=1, cutoff=0.5)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        raise FaultError(f"{key}: no event {text!r}{hint} (events: {FORMS})")
    kind, sign, rest = Kind(found[1]), found[2] or "", found[3] or ""
    if sign != _SIGN[kind]:
        raise FaultError(f"{key}: {text!r} is not how an event is written (events: {FORMS})")
    return _READ[kind](key, rest)


def _named(kind: Kind, names: tuple[str, ...]) -> Callable[[str, str], Event]:
    def read(key: str, name: str) -> Event:
        if name not in names:
            near = get_close_matches(name, names, n=1, cutoff=0.3)
            hint = f"did you mean '{near[0]}'? " if near else ""
            raise FaultError(f"{key}: no {kind} '{name}'; {hint}there are: {', '.join(names)}")
        return Event(kind, name)

    return read


def _fault(kind: Kind) -> Callable[[str, str], Event]:
    return lambda _, name: Event(kind, row(name).id)


def _force(key: str, text: str) -> Event:
    try:
        return Event(Kind.FORCE, value=_positive(quantity.parse(text, "N")))
    except ValueError as error:
        raise FaultError(f"{key}: force: {error}") from None


def _episode(key: str, text: str) -> Event:
    if not text.isdecimal():
        raise FaultError(f"{key}: episode >= {text!r}: write a whole number")
    return Event(Kind.EPISODE, value=int(text))


def _positive(newtons: float) -> float:
    if newtons < 0.0:
        raise ValueError(f"{newtons:g} N is below 0 N, which a size never is")
    return newtons


_SIGN: Final = {
    Kind.CONTACT: "",
    Kind.PHASE: ":",
    Kind.FORCE: ">",
    Kind.EPISODE: ">=",
    Kind.STATE: ":",
    Kind.ACTIVE: ":",
    Kind.CLEARED: ":",
}
_READ: Final[Mapping[Kind, Callable[[str, str], Event]]] = {
    Kind.CONTACT: lambda *_: Event(Kind.CONTACT),
    Kind.PHASE: _named(Kind.PHASE, PHASES),
    Kind.FORCE: _force,
    Kind.EPISODE: _episode,
    Kind.STATE: _named(Kind.STATE, STATES),
    Kind.ACTIVE: _fault(Kind.ACTIVE),
    Kind.CLEARED: _fault(Kind.CLEARED),
}
