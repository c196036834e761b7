"""Runs on several slots of this machine at once."""

from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from multiprocessing.connection import wait
from typing import Protocol, Self

from hil.campaign.run import Outcome, Run
from hil.campaign.slot import Slot, Work

POLL = 1.0
"""Wall seconds between looks for workers that do not answer."""


class Pool(Protocol):
    """Performs runs and yields each as it ends, in no particular order."""

    def outcomes(self, runs: Iterable[Run]) -> Iterator[tuple[Run, Outcome]]: ...


class LocalPool:
    """Owns `jobs` slots; one thread, the caller's."""

    def __init__(self, work: Work, jobs: int) -> None:
        self._slots = [Slot(work) for _ in range(jobs)]
        self._stack = ExitStack()

    def outcomes(self, runs: Iterable[Run]) -> Iterator[tuple[Run, Outcome]]:
        waiting = iter(runs)
        busy: dict[Slot, Run] = {}
        for slot, run in zip(self._slots, waiting, strict=False):
            slot.submit(run)
            busy[slot] = run
        while busy:
            for slot in _ended(list(busy)):
                ended, outcome = busy.pop(slot), slot.outcome()
                for run in waiting:
                    slot.submit(run)
                    busy[slot] = run
                    break
                yield ended, outcome

    def __enter__(self) -> Self:
        for slot in self._slots:
            self._stack.enter_context(slot)
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()


def _ended(busy: list[Slot]) -> list[Slot]:
    """Slots with an outcome at hand, or whose worker is past hope."""
    ready = wait([slot.fileno() for slot in busy], POLL)
    return [slot for slot in busy if slot.fileno() in ready or slot.overdue()]
