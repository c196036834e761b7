"""A force law on a gripped part: fetched, brought above the face, and pressed on it."""

from dataclasses import dataclass, replace

from controller.course import Course, Phase
from controller.job import fetch
from controller.laws.governor import Governor
from controller.outcome import Ending, Kind
from controller.phases.approach import approach
from controller.settings import Plan
from controller.track import Tracking, tracking
from drivers.interfaces import Gripper


@dataclass(frozen=True, slots=True)
class Held:
    """Which part, where it is pressed, and what holds it."""

    plan: Plan
    gripper: Gripper


def pressed(course: Course, axis: Governor, job: Tracking, held: Held) -> Phase[Ending]:
    """`tracking` from the plan's start on, a part in the jaws; ends early when there is none."""
    fetched = yield from fetch(course, held.plan, held.gripper)
    if fetched.kind is not Kind.DONE:
        return fetched
    yield from approach(course, held.plan.start, held.plan.travel)
    return (yield from tracking(course, axis, replace(job, start=course.setpoint)))
