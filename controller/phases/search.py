"""Stepping over the face under constant force until the slot takes the tip."""

from enum import Enum

from controller.action import Action, Answer, Pending, Policy, observation
from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.force_axis import ForceAxis
from controller.phases.contact import Face
from controller.ramp import ramp, ramp_periods
from controller.settings import Plan, Press, Search

CALM = 0.032
"""s: how long force and speed stay in their bands before a step counts as settled."""

PATIENCE = 2.0
"""s that a policy may think over one step; beyond that it counts as gone."""

REFUSALS = 5
"""Actions in a row that are none, after which the policy counts as broken and the search ends."""
_ACTIONS = frozenset(map(int, Action))


class Found(Enum):
    """Why the search ended."""

    SLOT = "slot"
    LIMIT = "limit"
    GIVEN_UP = "given up"


def search(course: Course, axis: ForceAxis, face: Face, policy: Policy, plan: Plan) -> Phase[Found]:
    """Ask the policy, step, settle, look; counts on in `course.steps`."""
    course.name = "search"
    while course.steps < plan.search.max_steps:
        if not (yield from take_step(course, axis, policy, plan.search)):
            return Found.GIVEN_UP
        if (yield from _settle(course, axis, face, plan.search, plan.press)):
            return Found.SLOT
    return Found.LIMIT


def take_step(
    course: Course, axis: ForceAxis | None, policy: Policy, search: Search
) -> Phase[bool]:
    """One ramped step, pressing or (without axis) hovering; False when the policy gives up."""
    action = accepted(course, (yield from _answer(course, axis, policy)))
    if action is None:
        return course.refused < REFUSALS and (yield from _wait(course, axis))
    course.steps += 1
    for dx, dy, dtheta in ramp(*step_of(course, action, search), ramp_periods(course.period)):
        held = axis.follow(course) if axis else course.setpoint
        yield from course.to(held.moved(dx, dy, 0.0, dtheta))
    return True


def _answer(course: Course, axis: ForceAxis | None, policy: Policy) -> Phase[Answer]:
    """What the policy says, the target held while it thinks; None when it takes too long."""
    for _ in range(round(PATIENCE / course.period)):
        answer = policy.choose(observation(course.cycle))
        if answer is not Pending.PENDING:
            return answer
        course.held += 1
        yield from _hold(course, axis)
    return None


def accepted(course: Course, chosen: object) -> Action | None:
    """The policy's action, if it is one of Eq. 2; whatever else it gave is refused and counted.

    Types are checked as the program runs: a learner's bug, or its NaN, ends here.
    """
    if chosen is None:
        course.refused = REFUSALS  # it gives up
        return None
    if isinstance(chosen, int) and not isinstance(chosen, bool) and chosen in _ACTIONS:
        course.refused = 0
        return Action(chosen)
    course.refused += 1
    return None


def _wait(course: Course, axis: ForceAxis | None) -> Phase[bool]:
    """Hold the target for as long as a step would have taken."""
    for _ in range(ramp_periods(course.period)):
        yield from _hold(course, axis)
    return True


def _hold(course: Course, axis: ForceAxis | None) -> Phase[Cycle]:
    """One period at the target, still pressing."""
    return (yield from course.to(axis.follow(course) if axis else course.setpoint))


def step_of(course: Course, action: Action, search: Search) -> tuple[float, float, float]:
    """Change of x, y (m) and theta (rad); nothing when it would lead further out of the box."""
    sizes = (search.step, search.step, search.step_rotation)
    here = (course.setpoint.x, course.setpoint.y, course.setpoint.theta)
    axis, size = action.axis, sizes[action.axis] * action.sign
    outside = abs(here[axis] + size) > (search.cells[axis] + 0.5) * sizes[axis]
    if outside and abs(here[axis] + size) > abs(here[axis]):
        size = 0.0
    return (size if axis == 0 else 0.0, size if axis == 1 else 0.0, size if axis == 2 else 0.0)


def _settle(
    course: Course, axis: ForceAxis, face: Face, search: Search, press: Press
) -> Phase[bool]:
    """Rest until the force is calm; True as soon as the tip has fallen into the slot."""
    begin, calm = course.cycle.t, 0.0
    while (rest := (course.cycle.t - begin) * 1e-9) < search.longest_rest:
        cycle = yield from course.to(axis.follow(course))
        if face.depth(cycle) > search.entry:
            return True
        near = abs(cycle.wrench[2] - press.force) < search.force_band
        calm = calm + course.period if near and abs(axis.velocity) < search.speed_band else 0.0
        if rest >= search.rest and calm >= CALM:
            return False
    return False
