"""Cooperative threads of one program: a slice each per control cycle, in the order they started.

A slice ends where robot time passes (motion, sleep, sync, join, sockets); until then a thread runs
alone. Script Manual, Thread scheduling. A started thread gets its first slice in the next cycle;
the manual leaves that open. A critical section adds nothing to that: it cannot reach over robot
time, because UR's own external control waits for its socket and servos in one.
"""

from collections.abc import Generator
from typing import Final, TypeAlias

from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import Blocking, Value, integer

Slices: TypeAlias = Generator[None, None, Value]

MAX_THREADS: Final = 100
"""Assumed: more means that a loop starts threads without end."""


class Halt(Exception):  # noqa: N818  # ends the program, nothing failed
    """The program said `halt`."""


class _Killed(Exception):  # noqa: N818
    """The thread killed itself."""


class Thread:
    """One line of execution; `handle` is what `run` returned, from 1 (the main thread has 0)."""

    __slots__ = ("handle", "slices")

    def __init__(self, handle: int, slices: Slices) -> None:
        self.handle = handle
        self.slices = slices


class Scheduler:
    """budget: loop turns and calls that all threads together may take in one cycle."""

    def __init__(self, budget: int, *, may_move: bool = True) -> None:
        self._may_move = may_move
        self._budget = budget
        self._left = budget
        self._threads: list[Thread] = []
        self._started = 0
        self._current: Thread | None = None
        self._mover: Thread | None = None

    @property
    def main(self) -> Thread | None:
        """The thread with handle 0, None once it has ended."""
        # The first one started, and nothing kills it: its handle is 0.
        first = self._threads[0] if self._threads else None
        return first if first is not None and first.handle == 0 else None

    def step(self) -> bool:
        """One slice of every thread, whose errors pass through; true while the main one lives."""
        self._left = self._budget
        self._mover = None
        for thread in tuple(self._threads):
            if thread in self._threads:
                self._slice(thread)
            if self.main is None:
                return False
        return True

    def _slice(self, thread: Thread) -> None:
        self._current = thread
        try:
            next(thread.slices)
        except (StopIteration, _Killed):
            self._end(thread)

    def _end(self, thread: Thread) -> None:
        self._threads.remove(thread)
        if self._mover is thread:
            self._mover = None

    def run(self, slices: Slices) -> int:
        """Start a thread and return its handle."""
        if len(self._threads) >= MAX_THREADS:
            raise ScriptError(f"more than {MAX_THREADS} threads")
        thread = Thread(self._started, slices)
        self._started += 1
        self._threads.append(thread)
        return thread.handle

    def kill(self, handle: Value) -> None:
        """End a thread; one that has ended already, or a handle of 0, is no error."""
        for thread in tuple(self._threads):
            if thread.handle == integer(handle) != 0:
                if thread is self._current:
                    raise _Killed
                thread.slices.close()
                self._end(thread)

    def join(self, handle: Value) -> Blocking:
        """Wait for the end of a thread."""
        wanted = integer(handle)
        while any(thread.handle == wanted != 0 for thread in self._threads):
            yield

    def spend(self) -> None:
        """Count a loop turn or a call against the cycle's budget."""
        self._left -= 1
        if self._left < 0:
            raise ScriptError("infinite loop")

    def claim(self) -> None:
        """Take the robot for this cycle."""
        if not self._may_move:
            raise ScriptError("a secondary program cannot move the robot")
        if self._mover not in (None, self._current):
            raise ScriptError("another thread is already controlling the robot")
        self._mover = self._current

    def close(self) -> None:
        """End every thread."""
        for thread in self._threads:
            thread.slices.close()
        self._threads.clear()
