"""Sliding into the slot: force along z, no force across it."""

from enum import Enum

from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.force_axis import ForceAxis
from controller.phases.contact import Face
from controller.settings import Insertion, Jam


class Inserted(Enum):
    """GOAL: the tip is at goal depth. STUCK: it stopped before."""

    GOAL = "goal"
    STUCK = "stuck"


def insert(course: Course, axis: ForceAxis, face: Face, insertion: Insertion) -> Phase[Inserted]:
    """Press on, give way sideways, until goal depth or no progress."""
    course.name = "insert"
    goal = insertion.goal_depth + insertion.overtravel
    deepest, since, wedged = face.depth(course.cycle), course.cycle.t, 0.0
    while (course.cycle.t - since) * 1e-9 < insertion.stall:
        dx, dy = yielding(course, insertion)
        cycle = yield from course.to(axis.follow(course).moved(dx, dy))
        depth = face.depth(cycle)
        if depth >= goal:
            return Inserted.GOAL
        if depth > deepest + insertion.progress:
            deepest, since = depth, cycle.t
        wedged = wedged + course.period if _at_rest(cycle, axis, face, insertion) else 0.0
        if insertion.jam is Jam.STEP_ON and wedged >= insertion.rest:
            return Inserted.STUCK
    return Inserted.STUCK


def _at_rest(cycle: Cycle, axis: ForceAxis, face: Face, insertion: Insertion) -> bool:
    """The full contact force on a tip that does not sink: on its way in either falls or moves."""
    pressed = abs(cycle.wrench[2] - face.force) < insertion.force_band
    return pressed and abs(axis.velocity) < insertion.speed_band


def draw_out(course: Course, insertion: Insertion) -> Phase[None]:
    """Lift a stuck part straight off to hover over the face.

    Not soft sideways: where the jaws gave way to while it was stuck is nearer to the slot.
    """
    course.name = "draw out"
    while course.setpoint.z < insertion.lift:
        dz = min(insertion.lift_speed * course.period, insertion.lift - course.setpoint.z)
        yield from course.to(course.setpoint.moved(dz=dz))
    yield from course.dwell(0.1)


def yielding(course: Course, insertion: Insertion) -> tuple[float, float]:
    """Step of x and y (m) that follows the push of the slot's walls, at a limited speed."""
    fx, fy = course.cycle.wrench[:2]
    top = insertion.lateral_speed
    vx = max(-top, min(top, fx / insertion.lateral_damping))
    vy = max(-top, min(top, fy / insertion.lateral_damping))
    return vx * course.period, vy * course.period
