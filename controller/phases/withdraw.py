"""Drawing back from what was met where nothing should be."""

from dataclasses import replace
from math import dist

from controller.course import Course, Phase
from controller.outcome import Ending, Kind
from controller.phases.approach import LEAVING_SPEED
from controller.phases.move import move
from controller.place import Place
from controller.settings import Travel


def withdraw(course: Course, clear: Place) -> Phase[Ending]:
    """Go straight back to a place on the way that led here, slowly; wants `Limits.relaxed`."""
    course.name = "withdraw"
    begin = course.setpoint
    yield from move(course, clear, replace(Travel(), speed=LEAVING_SPEED, acceleration=0.2))
    return Ending(Kind.DONE, f"drew back {dist(clear[:3], begin[:3]) * 1e3:.2g} mm")
