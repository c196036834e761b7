"""A job that is looked at while it goes on."""

from collections.abc import Callable
from typing import TypeAlias

from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.outcome import Ending

Look: TypeAlias = Callable[[Cycle, Course], None]


def watched(course: Course, job: Phase[Ending], look: Look) -> Phase[Ending]:
    """The job, each cycle shown before its command lets the cell move on."""
    try:
        setpoint = next(job)
        while True:
            look(course.cycle, course)
            setpoint = job.send((yield setpoint))
    except StopIteration as end:
        ending: Ending = end.value
        return ending
