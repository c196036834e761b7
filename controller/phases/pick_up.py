"""Taking a part from its fixture and putting it back."""

from controller.course import Course, Phase
from controller.phases.move import move, via
from controller.place import Place
from controller.settings import Grip, Travel
from drivers.interfaces import Gripper


def pick_up(
    course: Course, gripper: Gripper, part: Place, grip: Grip, travel: Travel
) -> Phase[bool]:
    """Fetch the part; False when the jaws closed on nothing (they open again and go up)."""
    course.name = "pick up"
    above = part.moved(dz=grip.height)
    gripper.open()
    yield from via(course, above, travel)
    yield from move(course, part, travel)
    gripper.close()
    gripped = yield from _wait_for(course, gripper, True, grip.wait)
    if not gripped:
        gripper.open()
        yield from course.dwell(grip.open_time)
    yield from move(course, above, travel)
    return gripped


def put_down(
    course: Course, gripper: Gripper, part: Place, grip: Grip, travel: Travel
) -> Phase[bool]:
    """Bring the part back to its fixture; False, and no further, when the jaws did not let go."""
    course.name = "put down"
    above = part.moved(dz=grip.height)
    yield from via(course, above, travel)
    yield from move(course, part, travel)
    released = yield from _let_go(course, gripper, grip)
    if released:
        yield from move(course, above, travel)
    return released


def release(course: Course, gripper: Gripper, grip: Grip) -> Phase[bool]:
    """Open the jaws where they are; whether they let go."""
    course.name = "release"
    return (yield from _let_go(course, gripper, grip))


def _let_go(course: Course, gripper: Gripper, grip: Grip) -> Phase[bool]:
    gripper.open()
    released = yield from _wait_for(course, gripper, False, grip.wait)
    yield from course.dwell(grip.open_time)
    return released


def _wait_for(course: Course, gripper: Gripper, holding: bool, wait: float) -> Phase[bool]:
    deadline = course.cycle.t + round(wait * 1e9)
    while course.cycle.t < deadline:
        yield from course.dwell(course.period)
        if gripper.holds(course.cycle.state) is holding:
            return True
    return False
