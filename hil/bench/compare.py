"""The whole loop beside the ring, in turn, so that neither has the better minutes."""

import gc
from dataclasses import dataclass
from statistics import median
from time import perf_counter

import numpy as np

from hil.app.undisturbed import undisturbed
from hil.bench.case import Case
from hil.bench.ring import ring
from hil.bench.run import START, speed
from hil.cell.errors import RigError
from hil.cell.rig import Rig
from hil.experiments.press import Press, over_connector

SETTLED = 2.0
"""Bench seconds before the ring's clock is read: pressed and warm."""


@dataclass(frozen=True, slots=True)
class Compared:
    """Times real time of a case and of the ring, run by run."""

    case: Case
    loop: tuple[float, ...]
    ring: tuple[float, ...]

    @property
    def ratios(self) -> tuple[float, ...]:
        """The loop's speed as a share of the ring's in the same pair."""
        return tuple(ours / bare for ours, bare in zip(self.loop, self.ring, strict=True))

    def figures(self) -> dict[str, object]:
        """As a program reads them."""
        return {"loop": self.loop, "ring": self.ring, "of_ring": median(self.ratios)}


def compare(rig: Rig, rig_text: bytes, case: Case, seconds: float, pairs: int) -> Compared:
    """Loop, ring, loop, ring; RigError for a case by the wall clock, which has no speed."""
    if case.clock != "lockstep":
        raise RigError(f"{case.name} runs by the wall clock: only a case in lockstep has a ring")
    runs = [
        (speed(rig, rig_text, case, seconds), ring_speed(case.rig(rig), case.contact, seconds))
        for _ in range(pairs)
    ]
    loop, bare = zip(*runs, strict=True)
    return Compared(case, loop, bare)


def ring_speed(rig: Rig, contact: bool, seconds: float) -> float:
    """How many times real time the ring presses the cable on the face, or holds it above."""
    period = rig.robot.period
    x, y = (cells * rig.task.step for cells in START[:2])
    placed = over_connector(rig, x, y)
    with undisturbed(wanted=True), ring(placed, np.random.default_rng(0)) as bare:
        trial = Press(lambda _rig, _rng: bare, rig, x, y, period=period)
        advance = trial.press if contact else trial.move
        for _ in range(round(SETTLED / period * 1e9)):
            advance()
        gc.collect()
        periods = max(1, round(seconds / period * 1e9))
        begin = perf_counter()
        for _ in range(periods):
            advance()
        return periods * period * 1e-9 / (perf_counter() - begin)
