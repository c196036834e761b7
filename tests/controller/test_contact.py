import pytest

from controller.force_axis import ForceAxis
from controller.guard import Limits
from controller.outcome import Ending, Kind
from controller.phases.contact import contact, nominal_face
from controller.place import Place
from controller.settings import Plan, Press

PLAN = Plan(part=Place(-0.1, 0.0, 0.0, 0.0), start=Place(0.0, 0.0, 0.005, 0.0))


def touch(cell):
    """What contact returned, and the mean forces along z of every cycle."""
    found = []

    def job(course):
        found.append((yield from contact(course, ForceAxis(PLAN.press, course.period), PLAN)))
        return Ending(Kind.DONE, "")

    outcome = cell.loop.run(job, Limits())
    assert outcome.kind is Kind.DONE, outcome.reason
    return found[0], [cycle.wrench[2] for cycle, _, _ in cell.seen]


@pytest.mark.parametrize("rate", [125, 500])
@pytest.mark.parametrize("stiffness", [5e3, 10e3, 16.5e3])
def test_the_force_settles_at_5_newtons_with_less_than_5_percent_overshoot(
    make_cell, rate, stiffness
):
    result, forces = touch(make_cell(rate=rate, stiffness=stiffness, at=(0.0, 0.0, 0.004, 0.0)))
    assert result.face.force == pytest.approx(5.0, abs=0.15)
    assert max(forces) < 5.0 * 1.05


def test_the_faces_height_is_where_the_spring_gives_the_force(make_cell):
    result, _ = touch(make_cell(at=(0.0, 0.0, 0.004, 0.0)))
    assert result.face.height == pytest.approx(-5.0 / 16.5e3, abs=0.02e-3)
    assert not result.in_slot


def test_a_tip_right_over_the_slot_is_noticed(make_cell):
    cell = make_cell(slot=(0.0, 0.0), at=(0.0, 0.0, 0.004, 0.0))
    result, _ = touch(cell)
    assert result.in_slot
    assert result.face == nominal_face(Press())


def test_nothing_to_touch_is_told(make_cell):
    cell = make_cell(stiffness=0.0, at=(0.0, 0.0, 0.004, 0.0))
    result, _ = touch(cell)
    assert result is None


def test_depth_counts_the_compression_that_a_falling_force_releases(make_cell):
    cell = make_cell(at=(0.0, 0.0, 0.004, 0.0))
    result, _ = touch(cell)
    pressed = cell.seen[-1][0]
    deeper = pressed._replace(stage=pressed.stage.moved(dz=-1e-3))
    relieved = deeper._replace(wrench=(0.0,) * 6)
    assert result.face.depth(deeper) == pytest.approx(1e-3, abs=0.02e-3)
    released = 5.0 / Press().stiffness
    assert result.face.depth(relieved) == pytest.approx(1e-3 + released, abs=0.02e-3)
