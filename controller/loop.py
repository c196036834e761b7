"""The control loop: one read, one decision and one command a period, and a safe end."""

from collections.abc import Callable
from contextlib import suppress
from typing import TypeAlias

from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.errors import ControlError, GuardTrip, Trip
from controller.filters import MovingMean
from controller.frames import TaskFrame, wrench_to_task
from controller.guard import Guard, Limits
from controller.outcome import Ending, Kind, Outcome
from controller.phases.withdraw import withdraw
from controller.place import Place
from controller.stop import come_to_rest
from drivers.errors import DriverError
from drivers.interfaces import Arm, ForceTorqueSensor

Job: TypeAlias = Callable[[Course], Phase[Ending]]
Observer: TypeAlias = Callable[[Cycle, Place, str], None]


def ignore(cycle: Cycle, setpoint: Place, phase: str) -> None:
    """The observer that records nothing."""


class Loop:
    """Runs jobs on one arm and sensor, each under its own limits.

    Enters and leaves a run with one command in flight, since an arm in lockstep answers only that.
    sensor_rate: samples per second.
    """

    def __init__(
        self,
        arm: Arm,
        sensor: ForceTorqueSensor,
        frame: TaskFrame,
        sensor_rate: float = 1000.0,
        observe: Observer = ignore,
    ) -> None:
        self._arm = arm
        self._sensor = sensor
        self._frame = frame
        self._mean = MovingMean(sensor_rate)
        self._observe = observe
        self._cycles = 0
        self._misses = 0
        self._t: int | None = None

    def run(self, job: Job, limits: Limits, *, leaving: bool = False) -> Outcome:
        """Drive the job to its end. A limit or a failing device stops the arm and is told in the
        Outcome; every other exception, KeyboardInterrupt too, stops the arm and goes on.

        After a force where nothing should be the arm draws back the way it came. leaving: the job
        takes the tool out of what pushes on it now, however hard, so the force must only not grow.
        """
        self._cycles, self._misses, self._t = 0, 0, None
        try:
            return self._ended(job, limits, leaving)
        except BaseException:
            with suppress(DriverError):  # a dead link must not hide what went wrong
                self._arm.stop()
            raise

    def _ended(self, job: Job, limits: Limits, leaving: bool) -> Outcome:
        course: Course | None = None
        try:
            cycle = self._cycle()
            bounds = limits.leaving(cycle.wrench) if leaving else limits
            guard = Guard(bounds, self._arm.period)
            course = Course(cycle, self._arm.period * 1e-9)
            ending = self._drive(job(course), course, guard)
        except (ControlError, DriverError) as error:
            return self._stopped(error, course, limits)
        return Outcome(ending.kind, ending.reason, course.steps, self._cycles, self._misses)

    def _drive(self, phase: Phase[Ending], course: Course, guard: Guard) -> Ending:
        cycle = course.cycle
        guard.check(cycle)
        try:
            setpoint = next(phase)
            while True:
                guard.check_setpoint(setpoint, cycle.stage)
                self._arm.servo(self._frame.to_base(setpoint))
                self._observe(cycle, setpoint, course.name)  # the arm has its command already
                cycle = self._cycle()
                guard.check(cycle)
                setpoint = phase.send(cycle)
        except StopIteration as end:
            self._arm.hold()
            ending: Ending = end.value
            return ending

    def _cycle(self) -> Cycle:
        state = self._arm.read()
        t = state.t
        if self._t is not None:
            self._misses += max(0, round((t - self._t) / self._arm.period) - 1)
        self._t = t
        self._cycles += 1
        reading = self._sensor.read(t)
        stage = self._frame.from_base(state.pose)
        return Cycle(t, state, reading, wrench_to_task(self._mean(reading), stage.theta), stage)

    def _stopped(self, error: Exception, course: Course | None, limits: Limits) -> Outcome:
        standstill = come_to_rest(self._arm)
        danger = isinstance(error, GuardTrip) and error.trip is Trip.FORCE
        kind = Kind.DANGER if danger else Kind.FAULT
        reason = str(error) if isinstance(error, ControlError) else _named(error)
        if danger and standstill and course is not None and course.way_back is not None:
            reason = f"{reason}; {self._withdrawn(course, course.way_back, limits)}"
        steps = course.steps if course else 0
        return Outcome(kind, reason, steps, self._cycles, self._misses, standstill)

    def _withdrawn(self, course: Course, clear: Place, limits: Limits) -> str:
        """Draw back under wide limits, and what came of it: the verdict on the job stands."""
        try:
            course.cycle = cycle = self._cycle()
            course.setpoint = cycle.stage
            guard = Guard(limits.leaving(cycle.wrench), self._arm.period)
            return self._drive(withdraw(course, clear), course, guard).reason
        except (ControlError, DriverError) as error:
            come_to_rest(self._arm)
            return f"not drawn back: {error}"


def _named(error: Exception) -> str:
    return f"{type(error).__name__}: {error}"
