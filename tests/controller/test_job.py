from dataclasses import replace
from functools import partial
from itertools import pairwise

import pytest

from controller import job as jobs
from controller.action import Action
from controller.guard import Limits
from controller.outcome import Kind
from controller.place import Place
from controller.settings import Jam, Plan, Search

PART = Place(-0.1, -0.05, 0.002, 0.0)
PLAN = Plan(part=PART, start=Place(0.6e-3, -0.3e-3, 0.005, 0.0))


class Walk:
    """Plays a list of actions, then gives up; `seen` holds what it was shown."""

    def __init__(self, *actions):
        self.actions = list(actions)
        self.seen = []

    def choose(self, observation):
        self.seen.append(observation)
        return self.actions.pop(0) if self.actions else None


HOME = (Action.MINUS_X, Action.MINUS_X, Action.PLUS_Y)


@pytest.fixture
def assemble(make_cell):
    def run(policy, plan=PLAN, **world):
        cell = make_cell(**{"slot": (0.0, 0.0), "part": PART, "at": (0.05, 0.0, 0.1, 0.2), **world})
        job = partial(
            jobs.assembly, plan=plan, sensor=cell.sensor, gripper=cell.gripper, policy=policy
        )
        return cell, cell.loop.run(job, Limits())

    return run


@pytest.mark.parametrize("rate", [125, 500])
def test_a_part_is_fetched_inserted_and_left_in_the_slot(assemble, rate):
    cell, outcome = assemble(Walk(*HOME), rate=rate)
    assert (outcome.kind, outcome.steps) == (Kind.INSERTED, 3)
    assert cell.phases() == [
        "pick up", "approach", "tare", "contact", "search", "insert", "release", "retract",
    ]  # fmt: skip
    deepest = min(cycle.stage.z for cycle, _, phase in cell.seen if phase == "insert")
    assert deepest < -PLAN.insertion.goal_depth
    assert not cell.world.holding
    assert cell.world.stage[2] == pytest.approx(PLAN.travel.height, abs=1e-3)


def test_the_policy_sees_contact_force_and_place_before_each_step(assemble):
    walk = Walk(*HOME)
    assemble(walk)
    assert [o.fz for o in walk.seen] == pytest.approx([5.0] * 3, abs=0.4)
    assert [o.x for o in walk.seen] == pytest.approx([0.6e-3, 0.3e-3, 0.0], abs=1e-5)


def test_a_step_is_ramped_over_48_ms(assemble):
    cell, _ = assemble(Walk(Action.PLUS_X))
    xs = [setpoint.x for _, setpoint, phase in cell.seen if phase == "search"]
    steps = [b - a for a, b in pairwise(xs) if b != a]
    assert steps == pytest.approx([PLAN.search.step / 6] * 5)


def test_a_missing_part_is_no_grip(assemble):
    cell, outcome = assemble(Walk(), part=Place(0.1, 0.1, 0.0, 0.0))
    assert outcome.kind is Kind.NO_GRIP
    assert cell.phases() == ["pick up"]


def test_a_search_that_finds_nothing_ends_at_k_max_and_puts_the_part_back(assemble):
    plan = replace(PLAN, search=Search(max_steps=5))
    cell, outcome = assemble(Walk(*[Action.PLUS_X, Action.MINUS_X] * 10), plan, slot=None)
    assert (outcome.kind, outcome.steps) == (Kind.LIMIT, 5)
    assert cell.phases()[-1] == "put down"
    assert not cell.world.holding


def test_a_policy_that_gives_up_ends_the_search(assemble):
    _, outcome = assemble(Walk(Action.PLUS_X), slot=None)
    assert outcome.kind is Kind.LIMIT
    assert outcome.reason == "the policy gave up after 1 steps"


def test_a_tip_that_meets_the_slot_at_once_needs_no_step(assemble):
    plan = replace(PLAN, start=Place(0.1e-3, 0.0, 0.005, 0.0))
    _, outcome = assemble(Walk(), plan)
    assert (outcome.kind, outcome.steps) == (Kind.INSERTED, 0)


def test_a_jammed_part_is_drawn_out_and_tried_beside(make_cell, assemble):
    plan = replace(PLAN, start=Place(0.0, 0.0, 0.005, 0.0))
    plan = replace(plan, insertion=replace(plan.insertion, goal_depth=3.0e-3))  # below the floor
    cell, outcome = assemble(Walk(Action.PLUS_X, Action.PLUS_X), plan)
    assert outcome.kind is Kind.LIMIT
    assert outcome.steps == 2
    phases = cell.phases()
    after = phases.index("draw out") + 1
    assert phases[after : after + 2] == ["contact", "search"]


def test_a_part_that_is_stuck_again_and_again_is_a_danger_and_is_put_back(assemble):
    plan = replace(PLAN, start=Place(0.0, 0.0, 0.005, 0.0))
    insertion = replace(plan.insertion, goal_depth=3.0e-3, jams=2)  # below the floor
    walk = Walk(*[Action.PLUS_THETA, Action.MINUS_THETA] * 10)
    cell, outcome = assemble(walk, replace(plan, insertion=insertion))
    assert (outcome.kind, outcome.reason) == (Kind.DANGER, "stuck in the slot 3 times")
    assert cell.phases().count("draw out") == 3
    assert cell.phases()[-1] == "put down"


def test_a_jammed_part_is_stepped_on_where_it_is_when_the_plan_says_so(assemble):
    insertion = replace(PLAN.insertion, goal_depth=3.0e-3, jam=Jam.STEP_ON)  # below the floor
    plan = replace(PLAN, start=Place(0.0, 0.0, 0.005, 0.0), insertion=insertion)
    cell, outcome = assemble(Walk(Action.PLUS_THETA, Action.MINUS_THETA), plan)
    assert (outcome.kind, outcome.steps) == (Kind.LIMIT, 2)
    phases = cell.phases()
    assert "draw out" not in phases
    jammed = phases[phases.index("insert") : phases.index("retract")]
    assert jammed == ["insert", "search", "insert", "search", "insert"]


def test_a_part_at_rest_in_a_jam_is_stepped_on_sooner_than_the_stall(assemble):
    insertion = replace(PLAN.insertion, goal_depth=3.0e-3, jam=Jam.STEP_ON)
    plan = replace(PLAN, start=Place(0.0, 0.0, 0.005, 0.0), insertion=insertion)
    cell, _ = assemble(Walk(Action.PLUS_X), plan)
    search = [i for i, (_, _, phase) in enumerate(cell.seen) if phase == "search"]
    last = [1 for _, _, phase in cell.seen[search[0] :] if phase == "insert"]
    assert len(last) * cell.arm.period * 1e-9 < insertion.stall


def test_a_lateral_push_while_inserting_is_nulled(assemble):
    cell, _ = assemble(Walk(*HOME), slot=(0.2e-3, -0.1e-3))
    last = [cycle.wrench for cycle, _, phase in cell.seen if phase == "insert"][-1]
    assert abs(last[0]) < 0.1
    assert abs(last[1]) < 0.1


def test_episodes_follow_each_other_with_one_grip(make_cell):
    cell = make_cell(slot=(0.0, 0.0), part=PART, at=(0.05, 0.0, 0.1, 0.0))
    assert (
        cell.loop.run(partial(jobs.fetch, plan=PLAN, gripper=cell.gripper), Limits()).kind
        is Kind.DONE
    )
    for _ in range(2):
        run = partial(jobs.episode, plan=PLAN, sensor=cell.sensor, policy=Walk(*HOME))
        assert cell.loop.run(run, Limits()).kind is Kind.INSERTED
        assert cell.world.holding
        leave = partial(jobs.leave, plan=PLAN)
        assert cell.loop.run(leave, Limits().relaxed()).kind is Kind.DONE
    back = partial(jobs.bring_back, plan=PLAN, gripper=cell.gripper)
    assert cell.loop.run(back, Limits()).kind is Kind.DONE
    assert not cell.world.holding


def test_an_episode_whose_part_is_lost_ends_before_it_touches_anything(make_cell):
    cell = make_cell(slot=(0.0, 0.0), part=PART, at=(0.05, 0.0, 0.1, 0.0))
    fetch = partial(jobs.fetch, plan=PLAN, gripper=cell.gripper)
    assert cell.loop.run(fetch, Limits()).kind is Kind.DONE
    cell.world.holding = False  # it slips out; the jaws stay closed
    run = partial(
        jobs.held_episode, plan=PLAN, sensor=cell.sensor, gripper=cell.gripper, policy=Walk(*HOME)
    )
    outcome = cell.loop.run(run, Limits())
    assert outcome.kind is Kind.FAULT
    assert "part lost" in outcome.reason
    assert outcome.cycles <= 5
    assert cell.world.stage[2] > PART.z


@pytest.mark.parametrize(("bias", "kind"), [(4.5, Kind.INSERTED), (5.5, Kind.FAULT)])
def test_a_force_in_free_air_is_zeroed_away_up_to_a_limit_only(make_cell, bias, kind):
    cell = make_cell(slot=(0.0, 0.0), part=PART, at=(0.05, 0.0, 0.1, 0.0))
    cell.world.extra = (0.0, 0.0, -bias, 0.0, 0.0, 0.0)
    job = partial(jobs.episode, plan=PLAN, sensor=cell.sensor, policy=Walk(*HOME))
    outcome = cell.loop.run(job, Limits())
    assert outcome.kind is kind, outcome.reason
    assert ("N in free air before zeroing" in outcome.reason) == (kind is Kind.FAULT)


def test_after_danger_the_arm_leaves_under_a_wider_bound(make_cell):
    cell = make_cell(at=(0.0, 0.0, 0.01, 0.0))
    cell.world.extra = (2.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert cell.loop.run(partial(jobs.leave, plan=PLAN), Limits()).kind is Kind.DANGER
    leave = partial(jobs.leave, plan=PLAN)
    assert cell.loop.run(leave, Limits().relaxed()).kind is Kind.DONE
    assert cell.world.stage[2] == pytest.approx(PLAN.travel.height, abs=1e-3)


def test_a_jammed_part_never_takes_more_steps_than_allowed(assemble):
    plan = replace(PLAN, start=Place(0.0, 0.0, 0.005, 0.0), search=Search(max_steps=1))
    plan = replace(plan, insertion=replace(plan.insertion, goal_depth=3.0e-3))
    _, outcome = assemble(Walk(*[Action.PLUS_THETA] * 10), plan)
    assert (outcome.kind, outcome.steps) == (Kind.LIMIT, 1)
