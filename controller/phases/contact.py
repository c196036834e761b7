"""Touching the connector's face and settling at the contact force."""

from dataclasses import dataclass

from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.force_axis import ForceAxis
from controller.settings import Press

STIFFNESS_RANGE = (2e3, 50e3)
"""N/m between which cable, pad and jaws are believed."""


@dataclass(frozen=True, slots=True)
class Face:
    """The connector's face as the contact found it: what depth is measured against.

    height: z of the TCP at contact force, m. force: N. stiffness: of cable and pad along z, N/m.
    """

    height: float
    force: float
    stiffness: float

    def depth(self, cycle: Cycle) -> float:
        """Estimated depth of the tip below the face, m.

        A part pressed less is longer: when the force falls the tip is deeper than the TCP tells, by
        the compression that was released.
        """
        relief = (self.force - cycle.wrench[2]) / self.stiffness
        return self.height - cycle.stage.z + relief


def contact(course: Course, axis: ForceAxis, press: Press) -> Phase[Face | None]:
    """Descend until touch, settle at the contact force; None when there was nothing to touch."""
    course.name = "contact"
    touched: Cycle | None = None
    deadline = course.cycle.t + round(press.patience * 1e9)
    calm = 0.0
    while course.cycle.t < deadline and course.cycle.stage.z > -press.reach:
        cycle = yield from course.to(axis.follow(course))
        if touched is None and cycle.wrench[2] > press.touch:
            touched = cycle
        calm = calm + course.period if _settled(cycle, axis, press) else 0.0
        if touched is not None and calm >= 0.064:
            return _face(touched, cycle)
    return None


def _settled(cycle: Cycle, axis: ForceAxis, press: Press) -> bool:
    return abs(cycle.wrench[2] - press.force) < press.tolerance and abs(axis.velocity) < 0.4e-3


def _face(touched: Cycle, settled: Cycle) -> Face:
    softest, stiffest = STIFFNESS_RANGE
    way = max(touched.stage.z - settled.stage.z, 1e-6)
    stiffness = (settled.wrench[2] - touched.wrench[2]) / way
    return Face(settled.stage.z, settled.wrench[2], min(max(stiffness, softest), stiffest))
