"""CPU time of the loop's parts, read from each thread's own clock: waiting costs nothing."""

from collections import defaultdict
from collections.abc import Callable
from time import thread_time_ns
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


class Meter:
    """Adds up CPU nanoseconds by part while it is `on`."""

    def __init__(self) -> None:
        self.spent: dict[str, int] = defaultdict(int)
        self.on = False

    def timed(self, part: str, function: Callable[P, R]) -> Callable[P, R]:
        """`function`, its CPU time counted for `part`."""
        spent = self.spent

        def measured(*args: P.args, **kwargs: P.kwargs) -> R:
            begin = thread_time_ns()
            try:
                return function(*args, **kwargs)
            finally:
                if self.on:
                    spent[part] += thread_time_ns() - begin

        return measured

    def wrap(self, part: str, owner: object, *methods: str) -> None:
        """Count these methods of one object for `part`."""
        for method in methods:
            setattr(owner, method, self.timed(part, getattr(owner, method)))

    def stand_in(self, part: str, owner: object, name: str, *methods: str) -> None:
        """Put a stand-in for `owner.name`, whose class allows no wrapped methods."""
        setattr(owner, name, _StandIn(self, part, getattr(owner, name), methods))


class _StandIn:
    """Everything of an object, some of its methods measured."""

    def __init__(self, meter: Meter, part: str, of: object, methods: tuple[str, ...]) -> None:
        self._of = of
        for method in methods:
            setattr(self, method, meter.timed(part, getattr(of, method)))

    def __getattr__(self, name: str) -> object:
        return getattr(self._of, name)
