"""Whole jobs, composed of phases."""

from controller.action import Policy
from controller.course import Course, Phase
from controller.force_axis import ForceAxis
from controller.outcome import Ending, Kind
from controller.phases.approach import approach, retract
from controller.phases.contact import Touch, contact
from controller.phases.insert import Inserted, draw_out, insert
from controller.phases.pick_up import pick_up, put_down, release
from controller.phases.search import Found, search, take_step
from controller.phases.tare import tare
from controller.settings import Jam, Plan, Travel
from drivers.interfaces import ForceTorqueSensor, Gripper


def assembly(
    course: Course, plan: Plan, sensor: ForceTorqueSensor, gripper: Gripper, policy: Policy
) -> Phase[Ending]:
    """Pick up the part, insert it, leave it there; a part that would not go in is put back."""
    if not (yield from pick_up(course, gripper, plan.part, plan.grip, plan.travel)):
        return _no_grip(plan)
    ending = yield from held_episode(course, plan, sensor, gripper, policy)
    if ending.kind is Kind.INSERTED and not (yield from release(course, gripper, plan.grip)):
        return _no_release(plan)
    yield from retract(course, plan.travel)
    if ending.kind is not Kind.INSERTED:
        yield from put_down(course, gripper, plan.part, plan.grip, plan.travel)
    return ending


def episode(course: Course, plan: Plan, sensor: ForceTorqueSensor, policy: Policy) -> Phase[Ending]:
    """One attempt with the part already in the jaws; the tool stays where it ended.

    `leave` under relaxed limits follows it, so that drawing the part out cannot change the verdict.
    """
    course.steps = 0
    yield from approach(course, plan.start, plan.travel)
    if plan.tare_samples:
        yield from tare(course, sensor, plan.tare_samples, plan.drift)
    return (yield from find_and_insert(course, plan, policy))


def held_episode(
    course: Course, plan: Plan, sensor: ForceTorqueSensor, gripper: Gripper, policy: Policy
) -> Phase[Ending]:
    """An episode in whose every cycle the jaws must feel the part; raises PartLostError."""
    course.carry(gripper.holds)
    ending = yield from episode(course, plan, sensor, policy)
    course.carry(None)
    return ending


def fetch(course: Course, plan: Plan, gripper: Gripper) -> Phase[Ending]:
    """Pick up the part and stop above its fixture."""
    if (yield from pick_up(course, gripper, plan.part, plan.grip, plan.travel)):
        return Ending(Kind.DONE, "part gripped")
    return _no_grip(plan)


def bring_back(course: Course, plan: Plan, gripper: Gripper) -> Phase[Ending]:
    """Put the part back into its fixture."""
    yield from put_down(course, gripper, plan.part, plan.grip, plan.travel)
    return Ending(Kind.DONE, "part put down")


def leave(course: Course, plan: Plan) -> Phase[Ending]:
    """Retract from wherever an episode or a stop left the tool; wants `Limits.relaxed`."""
    return (yield from lift(course, plan.travel))


def lift(course: Course, travel: Travel) -> Phase[Ending]:
    """Straight up to the crossing height, from wherever the tool is."""
    yield from retract(course, travel)
    return Ending(Kind.DONE, "retracted")


def find_and_insert(course: Course, plan: Plan, policy: Policy) -> Phase[Ending]:
    jams = 0
    while True:
        axis = ForceAxis(plan.press, course.period)
        touch = yield from contact(course, axis, plan)
        if touch is None:
            return Ending(Kind.FAULT, "the contact force did not settle on the connector's face")
        ending = yield from _search_and_insert(course, axis, touch, plan, policy)
        if ending is not None:
            return ending
        # A jammed part stays jammed however often it is pushed: out, one step on, and down again.
        yield from draw_out(course, plan.insertion)
        jams += 1
        if jams > plan.insertion.jams:
            return Ending(Kind.DANGER, f"stuck in the slot {jams} times")
        if course.steps >= plan.search.max_steps:
            return _limit(course, Found.LIMIT)
        if not (yield from take_step(course, None, policy, plan.search)):
            return _limit(course, Found.GIVEN_UP)


def _search_and_insert(
    course: Course, axis: ForceAxis, touch: Touch, plan: Plan, policy: Policy
) -> Phase[Ending | None]:
    """From the face to an ending; None for a jammed part that is to be drawn out."""
    in_slot = touch.in_slot
    while True:
        if not in_slot:
            found = yield from search(course, axis, touch.face, policy, plan)
            if found is not Found.SLOT:
                return _limit(course, found)
        if (yield from insert(course, axis, touch.face, plan.insertion)) is Inserted.GOAL:
            return Ending(Kind.INSERTED, f"goal depth reached after {course.steps} steps")
        if plan.insertion.jam is Jam.DRAW_OUT:
            return None
        in_slot = False


def _limit(course: Course, found: Found) -> Ending:
    if found is Found.GIVEN_UP:
        return Ending(Kind.LIMIT, f"the policy gave up after {course.steps} steps")
    return Ending(Kind.LIMIT, f"no insertion within {course.steps} steps")


def _no_release(plan: Plan) -> Ending:
    return Ending(
        Kind.FAULT, f"jaws still hold the part {plan.grip.wait} s after opening: not moved away"
    )


def _no_grip(plan: Plan) -> Ending:
    return Ending(Kind.NO_GRIP, f"no part sensed within {plan.grip.wait} s of closing the jaws")
