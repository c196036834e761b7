"""Touching the connector's face and settling at the contact force."""

from dataclasses import dataclass

from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.force_axis import ForceAxis
from controller.settings import Plan, Press

CALM = 0.064
"""s: how long the force stays settled before the face counts as found."""


@dataclass(frozen=True, slots=True)
class Face:
    """The connector's face as the tool feels it: what depth is measured against.

    height: z of the TCP when pressing with force (N), m. stiffness: of cable and pad along z, N/m.
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


@dataclass(frozen=True, slots=True)
class Touch:
    """What the descent ended on; in_slot: the tip went in at once."""

    face: Face
    in_slot: bool


def contact(course: Course, axis: ForceAxis, plan: Plan) -> Phase[Touch | None]:
    """Descend until touch, settle at the contact force; None when there was nothing to touch."""
    course.name = "contact"
    press = plan.press
    nominal = nominal_face(press)
    deadline = course.cycle.t + round(press.patience * 1e9)
    calm = 0.0
    while course.cycle.t < deadline and course.cycle.stage.z > -press.reach:
        cycle = yield from course.to(axis.follow(course))
        if cycle.wrench[2] > press.touch and nominal.depth(cycle) > plan.search.entry:
            return Touch(nominal, in_slot=True)
        calm = calm + course.period if _settled(cycle, axis, press) else 0.0
        if calm >= CALM:
            face = Face(cycle.stage.z, cycle.wrench[2], press.stiffness)
            return Touch(face, in_slot=False)
    return None


def nominal_face(press: Press) -> Face:
    """The face where the task frame says it is."""
    return Face(-press.force / press.stiffness, press.force, press.stiffness)


def _settled(cycle: Cycle, axis: ForceAxis, press: Press) -> bool:
    return abs(cycle.wrench[2] - press.force) < press.tolerance and abs(axis.velocity) < 0.4e-3
