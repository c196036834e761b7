"""The z axis under force control: one admittance and its velocity."""

from controller.admittance import Admittance
from controller.course import Course
from controller.place import Place
from controller.settings import Press


class ForceAxis:
    """Holds the contact force; `advance` gives the next z step. Downward speed is limited.

    velocity: of the set-point, m/s, outward positive.
    """

    __slots__ = ("_law", "_settings", "velocity")

    def __init__(self, settings: Press, period: float) -> None:
        self._settings = settings
        self._law = Admittance(settings.mass, settings.damping, period)
        self.velocity = 0.0

    def advance(self, push: float) -> float:
        """Change of z for this period, m, from the push along z in N."""
        # Peak force is k v theta beyond what was felt: speed, not gain, bounds a first touch.
        velocity = self._law.velocity(self.velocity, push - self._settings.force)
        self.velocity = max(velocity, -self._settings.descent)
        return self.velocity * self._law.period

    def follow(self, course: Course) -> Place:
        """The last set-point moved along z by this period's step."""
        return course.setpoint.moved(dz=self.advance(course.cycle.wrench[2]))
