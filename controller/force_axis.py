"""The z axis under force control while a job runs."""

from math import inf

from controller.course import Course
from controller.laws.bounds import Bounds
from controller.laws.build import build
from controller.laws.constant import ConstantSettings
from controller.laws.interface import AxisLaw, AxisReading, Reference
from controller.place import Place
from controller.settings import Press


class ForceAxis:
    """Holds the contact force by Eq. 13; `follow` gives the next set-point.

    It feels the 8 ms mean on which every decision of a job rests, and the guard ends the run on a
    force or a sample's age out of bounds, so that the law's own force stop stays out of the way.
    """

    __slots__ = ("_law", "_reference")

    def __init__(self, settings: Press, period: float) -> None:
        """period: s."""
        self._reference = Reference(settings.force)
        self._law = press_law(settings, round(period * 1e9))

    @property
    def velocity(self) -> float:
        """Of the set-point, m/s, outward positive."""
        return self._law.velocity

    def follow(self, course: Course) -> Place:
        """The last set-point moved along z by this period's step."""
        cycle = course.cycle
        reading = AxisReading(cycle.t, (cycle.wrench[2],), cycle.stage.z)
        return course.setpoint.moved(dz=self._law.step(reading, self._reference))


def press_law(settings: Press, period: int) -> AxisLaw:
    """The law of the contact, search and insert phases. period: ns."""
    # Peak force is k v theta beyond what was felt: speed, not gain, bounds a first touch.
    bounds = Bounds(
        approach=settings.descent,
        push=settings.descent,
        retreat=inf,
        speed=inf,
        acceleration=inf,
        contact=settings.touch,
        stop=inf,
    )
    return build("constant", ConstantSettings(settings.mass, settings.damping), bounds, period)
