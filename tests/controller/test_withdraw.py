"""What is met where nothing should be is drawn back from, the way it was come upon."""

import pytest

from controller.course import CLEAR
from controller.guard import Limits
from controller.outcome import Kind
from controller.phases.move import move
from controller.place import Place
from controller.settings import Travel

DEEP = Place(0.0, 0.0, -2e-3, 0.0)


def down(name):
    def job(course):
        course.name = name
        yield from move(course, DEEP, Travel())

    return job


@pytest.mark.parametrize("rate", [125, 500])
@pytest.mark.parametrize("name", ["pick up", "approach", "put down"])
def test_an_arm_that_meets_something_in_free_air_ends_clear_of_it(make_cell, name, rate):
    cell = make_cell(rate)
    outcome = cell.loop.run(down(name), Limits())
    assert outcome.kind is Kind.DANGER
    assert "drew back" in outcome.reason
    assert cell.world.stage[2] > CLEAR / 2
    assert cell.phases()[-1] == "withdraw"
    cell.arm.read()  # one command is in flight


def test_it_goes_back_the_way_it_came(make_cell):
    def job(course):
        course.name = "approach"
        yield from move(course, Place(0.02, 0.0, -2e-3, 0.0), Travel())

    cell = make_cell()
    cell.loop.run(job, Limits())
    x, _, z, _ = cell.world.stage
    assert x == pytest.approx(0.02 * (0.02 - z) / 0.022, abs=0.5e-3)


@pytest.mark.parametrize("name", ["contact", "search", "insert", "retract"])
def test_a_contact_that_was_looked_for_is_left_to_whoever_knows_what_holds_the_part(
    make_cell, name
):
    cell = make_cell()
    outcome = cell.loop.run(down(name), Limits())
    assert outcome.kind is Kind.DANGER
    assert "drew back" not in outcome.reason
    assert cell.world.stage[2] < 0.0


def test_it_gives_drawing_back_up_when_the_force_only_grows(make_cell):
    cell = make_cell()

    def push(phase):
        depth = -cell.world.stage[2]
        cell.world.extra = (0.0, 0.0, -1e5 * (0.02 - depth if depth < 0 else 0.02), 0.0, 0.0, 0.0)

    cell.loop._observe = lambda _c, _s, phase: push(phase) if phase == "withdraw" else None
    outcome = cell.loop.run(down("approach"), Limits())
    assert outcome.kind is Kind.DANGER
    assert "not drawn back: force" in outcome.reason
    assert cell.arm.stops >= 2
