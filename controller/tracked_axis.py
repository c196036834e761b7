"""One axis under a force law: readings in, set-points out, period by period."""

from controller.alignment import AlignedPosition
from controller.course import Course, Phase
from controller.laws.governor import Governor
from controller.laws.interface import AxisReading, Reference
from controller.place import Place


class TrackedAxis:
    """The law along z, fed with force and position of the same moment."""

    __slots__ = ("_course", "_position", "axis")

    def __init__(self, course: Course, axis: Governor) -> None:
        self._course, self.axis = course, axis
        self._position = AlignedPosition(round(course.period * 1e9))

    def to(self, reference: Reference, x: float) -> Phase[None]:
        """One period of the law, the set-point at x (m)."""
        cycle, reading = self._course.cycle, self._course.cycle.reading
        # The sensor's z points into the surface: a push on the tool is a negative fz.
        push = tuple([-sample[2] for sample in reading.samples])
        place = self._position.at(cycle.t, cycle.stage.z, reading.age)
        dz = self.axis.step(AxisReading(cycle.t, push, place), reference)
        _, y, z, theta = self._course.setpoint
        yield from self._course.to(Place(x, y, z + dz, theta))
