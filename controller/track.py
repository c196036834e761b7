"""A force-tracking job: down through free air, hold a force, slide along the surface under it."""

from dataclasses import dataclass, field

from controller.course import Course, Phase
from controller.laws.governor import Governor
from controller.outcome import Ending, Kind
from controller.phases.move import move
from controller.place import Place
from controller.reference import ForceProfile, Slide, Step
from controller.settings import Travel
from controller.tracked_axis import TrackedAxis

ORIGIN = Place(0.0, 0.0, 0.0, 0.0)
GENTLE = Travel(speed=20e-3, acceleration=0.1)


@dataclass(frozen=True, slots=True)
class Tracking:
    """One experiment: where it starts, what to hold, and for how long; times in s.

    touch: mean push that counts as the first contact, N. patience: longest way down.
    """

    start: Place = ORIGIN
    force: ForceProfile = field(default_factory=lambda: Step(10.0))
    slide: Slide = field(default_factory=Slide)
    hold: float = 3.2
    moving: float = 8.0
    touch: float = 0.4
    rest: float = 0.3
    patience: float = 10.0


def tracking(course: Course, axis: Governor, job: Tracking) -> Phase[Ending]:
    """Phases `start`, `lower`, `hold`, `slide`; ends early when the force stop latches."""
    yield from move(course, job.start, GENTLE)
    yield from course.dwell(job.rest)
    axis.reset(course.setpoint.z)
    tracked = TrackedAxis(course, axis)
    if not (yield from _lower(course, tracked, job)):
        return _stopped(axis) or Ending(Kind.FAULT, f"no contact within {job.patience:g} s")
    touched = course.cycle.t
    for name, duration, slide in (("hold", job.hold, None), ("slide", job.moving, job.slide)):
        course.name = name
        yield from _under_force(course, tracked, job.force, _Leg(touched, duration, slide))
        if axis.tripped:
            break
    return _stopped(axis) or Ending(Kind.DONE, "tracked to the end")


@dataclass(frozen=True, slots=True)
class _Leg:
    """touched: arm time of the first contact, ns, where the profile begins. duration: s."""

    touched: int
    duration: float
    slide: Slide | None


def _lower(course: Course, tracked: TrackedAxis, job: Tracking) -> Phase[bool]:
    """Down until the first touch; whether there was one."""
    course.name = "lower"
    reference = job.force.at(0.0)
    for _ in range(round(job.patience / course.period)):
        yield from tracked.to(reference, course.setpoint.x)
        if course.cycle.wrench[2] > job.touch or tracked.axis.tripped:
            return not tracked.axis.tripped
    return False


def _under_force(
    course: Course, tracked: TrackedAxis, force: ForceProfile, leg: _Leg
) -> Phase[None]:
    begin, x = course.cycle.t, course.setpoint.x
    while not tracked.axis.tripped and (t := (course.cycle.t - begin) * 1e-9) < leg.duration:
        way = leg.slide.at(t) if leg.slide else 0.0
        reference = force.at((course.cycle.t - leg.touched) * 1e-9)
        yield from tracked.to(reference, x + way)


def _stopped(axis: Governor) -> Ending | None:
    return Ending(Kind.DANGER, "the law's force stop latched") if axis.tripped else None
