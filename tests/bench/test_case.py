import pytest

from hil.bench.case import CASES, WALL_CASES, chosen
from hil.cell.errors import RigError
from hil_fixtures.testbed import shipped

ALL = (*CASES, *WALL_CASES)


@pytest.mark.parametrize("case", ALL, ids=lambda case: case.name)
def test_every_case_is_found_by_its_name(case):
    assert chosen((case.name,)) == (case,)


def test_cases_keep_the_order_in_which_they_were_asked_for():
    assert chosen((ALL[2].name, ALL[0].name)) == (ALL[2], ALL[0])


def test_without_names_nothing_waits_for_the_wall_clock():
    assert chosen(()) == CASES
    assert {case.clock for case in CASES} == {"lockstep"}


def test_an_unknown_case_names_the_nearest_and_lists_all():
    with pytest.raises(RigError, match="did you mean 'free_125hz_1ms'") as refusal:
        chosen((ALL[0].name, "free_125_1ms"))
    assert all(case.name in str(refusal.value) for case in ALL)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("case", ALL, ids=lambda case: case.name)
def test_a_case_changes_rate_step_and_clock_and_nothing_else(case):
    rig = shipped("ffc_ur5")
    made = case.rig(rig)
    assert made.robot.rate == (500 if "500hz" in case.name else 125)
    assert made.physics.step == case.step
    assert made.clock == case.clock
    kept = {"robot", "physics", "clock"}
    assert made.model_dump(exclude=kept) == rig.model_dump(exclude=kept)


def test_names_of_cases_differ():
    assert len({case.name for case in ALL}) == len(ALL)
