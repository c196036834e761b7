"""rtde_set_watchdog: what happens when an RTDE input falls silent."""

from collections.abc import Iterable
from enum import Enum
from typing import Final

from hil.cell.arm.inputs import Values

NS: Final = 1_000_000_000


class Action(Enum):
    """IGNORE: nothing. PAUSE: the program pauses. STOP: a protective stop, as on CB3 (C207A0)."""

    IGNORE = "ignore"
    PAUSE = "pause"
    STOP = "stop"


class Watchdog:
    """Deadlines by input name; one trip each, until the input is heard again."""

    __slots__ = ("_watched",)

    def __init__(self) -> None:
        self._watched: dict[str, tuple[int, Action, int]] = {}

    def watch(self, name: str, minimum_frequency: float, action: str, t: int) -> None:
        """Expect `name` at `minimum_frequency`, Hz, from bench time t on; ValueError otherwise."""
        if not minimum_frequency > 0.0:
            raise ValueError(f"minimum frequency must be above 0 Hz, found {minimum_frequency}")
        limit = round(NS / minimum_frequency)
        self._watched[name] = (limit, Action(action.lower()), t + limit)

    @property
    def idle(self) -> bool:
        """Whether no input is expected."""
        return not self._watched

    def clear(self) -> None:
        """Watch nothing: the program that asked has ended."""
        self._watched.clear()

    def forget(self, name: str) -> None:
        """Expect `name` no more."""
        self._watched.pop(name, None)

    def heard(self, packages: Iterable[Values], t: int) -> None:
        """Note the inputs that arrived at t, ns."""
        if not self._watched:
            return
        for values in packages:
            for name in self._watched.keys() & values.keys():
                limit, action, _ = self._watched[name]
                self._watched[name] = (limit, action, t + limit)

    def tripped(self, t: int) -> tuple[str, Action] | None:
        """The first input silent beyond its limit at t, and what to do; it is then forgotten."""
        for name, (_, action, deadline) in self._watched.items():
            if t > deadline:
                del self._watched[name]
                return name, action
        return None
