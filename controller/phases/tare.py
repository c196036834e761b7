"""Zeroing the sensor in free air, in the middle of a job."""

from math import hypot

from controller.course import Course, Phase
from controller.errors import DriftError
from drivers.errors import NotReadyError
from drivers.interfaces import ForceTorqueSensor

PATIENCE = 3.0
"""s, longer than any command's retries."""


def tare(course: Course, sensor: ForceTorqueSensor, samples: int, drift: float) -> Phase[None]:
    """Stand still until the node has zeroed itself; the drift since the last tare is gone.

    The loop's own reading polls the sensor meanwhile. Raises NotReadyError when no answer comes,
    and DriftError for a force above `drift` (N): a zeroing would hide a failing or pushed sensor.
    """
    course.name = "tare"
    force = hypot(*course.cycle.wrench[:3])
    if force > drift:
        raise DriftError(f"{force:.3g} N in free air before zeroing, allowed are {drift:.3g} N")
    sensor.begin_tare(samples)
    deadline = course.cycle.t + round(PATIENCE * 1e9)
    yield from course.dwell(course.period)
    while sensor.tare_pending:
        if course.cycle.t > deadline:
            raise NotReadyError(f"no tare within {PATIENCE} s of arm time")
        yield from course.dwell(course.period)
    # The window of the mean still holds samples from before the new zero.
    yield from course.dwell(0.02)
