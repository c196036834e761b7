"""When a fault begins: in bench time, at an event, by chance, again and again."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from math import isfinite
from typing import Final

import numpy as np

from hil.cell.errors import FaultError
from hil.cell.faults.event import Event, Kind, event
from hil.cell.faults.situation import Situation
from hil.cell.faults.span import NOW, NS, Span, span

KEYS: Final = ("at", "cycle", "event", "prob", "offset", "every")
_STARTS: Final = KEYS[:4]


@dataclass(frozen=True, slots=True)
class Trigger:
    """At most one of at (ns), cycle, event and prob (a cycle); none of them is power-up.

    offset: so much later. every: from then on again and again.
    """

    at: int | None = None
    cycle: int | None = None
    event: Event | None = None
    prob: float | None = None
    offset: Span = NOW
    every: Span | None = None

    def __str__(self) -> str:
        written = [f"{key}: {value}" for key, value in self.written().items()]
        return ", ".join(written) or "at: 0 s"

    def written(self) -> dict[str, str | int]:
        """As a schedule file has it."""
        found: dict[str, str | int] = {}
        if self.at is not None:
            found["at"] = f"{self.at / NS!r} s"
        if self.cycle is not None:
            found["cycle"] = self.cycle
        if self.event is not None:
            found["event"] = str(self.event)
        if self.prob is not None:
            found["prob"] = f"{self.prob!r}/cycle"
        if self.offset != NOW:
            found["offset"] = f"+{self.offset}"
        if self.every is not None:
            found["every"] = str(self.every)
        return found


AT_ONCE: Final = Trigger()
"""From power-up on."""


class Watch:
    """One trigger in one run: told each period in turn, it says whether the fault begins now.

    rng: for `prob` alone; it draws once a period, so a run repeats.
    """

    def __init__(self, trigger: Trigger, period: int, rng: np.random.Generator) -> None:
        self._trigger, self._period, self._rng = trigger, period, rng
        self._due: int | None = None
        self._held = False

    def fires(self, now: Situation) -> bool:
        """Whether it fires in this period; without `every` it does so once."""
        if self._due is None and self._begins(now):
            self._due = now.t + self._trigger.offset.long(self._period)
        if self._due is None or now.t < self._due:
            return False
        every = self._trigger.every
        self._due = _NEVER if every is None else self._due + every.long(self._period)
        return True

    def _begins(self, now: Situation) -> bool:
        trigger = self._trigger
        if trigger.prob is not None:
            return bool(self._rng.random() < trigger.prob)
        if trigger.event is not None:
            return trigger.event.holds(now)
        if trigger.cycle is not None:
            return now.cycle >= trigger.cycle
        return now.t >= (trigger.at or 0)


_NEVER: Final = 1 << 62


def trigger(key: str, content: object) -> Trigger:
    """Parse a mapping, or one event's text; FaultError is one line that begins with `key`."""
    if isinstance(content, str):
        return Trigger(event=event(key, content))
    if not isinstance(content, Mapping):
        raise FaultError(f"{key}: {content!r} is no trigger; write one of {', '.join(KEYS)}")
    for name in content:
        if name not in KEYS:
            near = get_close_matches(str(name), KEYS, n=1, cutoff=0.0)
            raise FaultError(f"{key}.{name}: no such key; did you mean '{near[0]}'?")
    starts = [name for name in _STARTS if name in content]
    if len(starts) > 1:
        raise FaultError(f"{key}: {' and '.join(starts)} are two beginnings; take one of them")
    return Trigger(
        at=_time(f"{key}.at", content["at"]) if "at" in content else None,
        cycle=_cycle(f"{key}.cycle", content["cycle"]) if "cycle" in content else None,
        event=event(f"{key}.event", content["event"]) if "event" in content else None,
        prob=_chance(f"{key}.prob", content["prob"]) if "prob" in content else None,
        offset=span(f"{key}.offset", content.get("offset", 0)),
        every=_every(f"{key}.every", content["every"]) if "every" in content else None,
    )


def never(trigger: Trigger, period: int, episodes: int, others: Collection[str] = ()) -> str:
    """Why it can never fire in a run of so many episodes; "" when it can.

    others: ids of the faults that the same end of the wire injects besides.
    """
    waited = trigger.event
    if waited is not None and waited.kind is Kind.EPISODE and waited.value > episodes:
        return f"the run has {episodes} episode{'s' * (episodes != 1)}, it waits for {waited}"
    chained = waited is not None and waited.kind in (Kind.ACTIVE, Kind.CLEARED)
    if waited is not None and chained and waited.name not in others:
        there = ", ".join(sorted(others)) or "none"
        return f"it waits for {waited}; faults beside it on this side of the wire: {there}"
    if trigger.every is not None and trigger.every.long(period) < period:
        return f"every {trigger.every} is less than a control period of {period / 1e6:g} ms"
    return ""


def _time(key: str, content: object) -> int:
    found = span(key, content)
    if found.cycles:
        raise FaultError(f"{key}: {content!r} has no unit of time; write 'cycle: {found.cycles}'")
    return found.ns


def _cycle(key: str, content: object) -> int:
    if isinstance(content, bool) or not isinstance(content, int) or content < 0:
        raise FaultError(f"{key}: {content!r} is not a whole number >= 0")
    return content


def _chance(key: str, content: object) -> float:
    text = str(content).removesuffix("/cycle").strip()
    try:
        chance = float(text)
    except ValueError:
        chance = -1.0
    if not (isfinite(chance) and 0.0 < chance <= 1.0):
        raise FaultError(f"{key}: {content!r} is not a chance in (0, 1] such as '0.01/cycle'")
    return chance


def _every(key: str, content: object) -> Span:
    found = span(key, content)
    if found == NOW:
        raise FaultError(f"{key}: {content!r} is no time at all; write '50 cycles' or '0.5 s'")
    return found
