"""Going to the start above the connector, and leaving it."""

from dataclasses import replace

from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.phases.move import move, via
from controller.place import Place
from controller.settings import Travel

LEAVING_SPEED = 0.02
"""m/s: a seated cable is pulled out against its terminals, 4 N of dry friction."""


def approach(course: Course, start: Place, travel: Travel) -> Phase[Cycle]:
    """Go above the start, down to it, and let the arm come to rest."""
    course.name = "approach"
    yield from via(course, start, travel)
    return (yield from course.dwell(0.15))


def retract(course: Course, travel: Travel) -> Phase[Cycle]:
    """Leave straight up, slowly at first, to the crossing height."""
    course.name = "retract"
    clear = course.setpoint.at(min(course.setpoint.z + 5e-3, travel.height))
    if clear.z > course.setpoint.z:
        yield from move(course, clear, replace(travel, speed=LEAVING_SPEED, acceleration=0.2))
    return (yield from move(course, clear.at(max(clear.z, travel.height)), travel))
