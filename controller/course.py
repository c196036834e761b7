"""The thread that runs through a job: last cycle, last set-point, phase and step count."""

from collections.abc import Generator
from typing import TypeAlias, TypeVar

from controller.cycle import Cycle
from controller.place import Place

R = TypeVar("R")
Phase: TypeAlias = Generator[Place, Cycle, R]
"""A phase yields a set-point, receives the next cycle, and returns how it ended."""


class Course:
    """Where a job stands. Phases move it on; the loop, recorders and screens read it.

    period: of the control loop, s. name: of the running phase. steps: search steps taken (k).
    """

    __slots__ = ("cycle", "name", "period", "setpoint", "steps")

    def __init__(self, cycle: Cycle, period: float) -> None:
        self.cycle = cycle
        self.setpoint = cycle.stage
        self.period = period
        self.name = "start"
        self.steps = 0

    def to(self, place: Place) -> Phase[Cycle]:
        """Send one set-point and wait for the cycle that follows it."""
        self.setpoint = place
        self.cycle = yield place
        return self.cycle

    def dwell(self, duration: float) -> Phase[Cycle]:
        """Stay at the last set-point for so many seconds."""
        for _ in range(max(1, round(duration / self.period))):
            yield from self.to(self.setpoint)
        return self.cycle
