"""What clients did at the doors: every event counted, few of each kind written to the log."""

from collections import Counter
from collections.abc import Callable
from enum import StrEnum
from typing import Final

Say = Callable[[str], None]

SAID: Final = 3
"""Events of a kind that get a line each; after them only the 10th, the 100th and so on, so that a
flood neither fills the log nor hides what else stands there."""


class Event(StrEnum):
    """Kinds of events, as counters name them."""

    LEFT = "left"
    LOST = "lost"
    CUT_OFF = "cut off"
    TURNED_AWAY = "turned away"
    REFUSED = "packages refused"
    RESTED = "periods over the share"


class DoorLog:
    """Counts without end, in bounded memory."""

    __slots__ = ("_counts", "_say")

    def __init__(self, say: Say) -> None:
        self._say = say
        self._counts: Counter[Event] = Counter()

    def count(self, event: Event) -> None:
        """One event that needs no line."""
        self._counts[event] += 1

    def note(self, event: Event, line: str) -> None:
        """Count one event; `line` goes to the log if it is one of the few that do."""
        self.count(event)
        count = self._counts[event]
        if count <= SAID:
            self._say(line)
        elif _round(count):
            self._say(f"{line} ({event}: {count} so far, most without a line of their own)")

    @property
    def counts(self) -> dict[str, int]:
        """How often each kind happened; kinds that did not are left out."""
        return {event.value: self._counts[event] for event in Event if self._counts[event]}


def _round(count: int) -> bool:
    digits = str(count)
    return digits[0] == "1" and not digits[1:].strip("0")
