import numpy as np
import pytest

GOAL = 2.0e-3


def test_a_part_at_goal_depth_in_the_slot_is_seated(watched):
    assert not watched.referee.seated
    watched.period("insert", depth=GOAL)
    assert watched.referee.seated


@pytest.mark.parametrize(
    "wrong", [{"depth": GOAL - 1e-6}, {"tip": (0.11e-3, 0.0)}, {"tip": (0.0, -0.11e-3)}]
)
def test_a_part_too_high_or_beside_the_slot_is_not_seated(watched, wrong):
    watched.period("insert", **{"depth": GOAL} | wrong)
    assert not watched.referee.seated


def test_a_part_that_comes_out_again_is_not_seated(watched):
    watched.period("insert", depth=GOAL)
    watched.period("insert", depth=GOAL / 2)
    assert not watched.referee.seated


def test_what_lies_deep_before_the_insertion_is_no_insertion(watched):
    watched.period("search", depth=GOAL)
    assert not watched.referee.seated


def test_the_verdict_is_the_last_one_with_the_part_in_the_jaws(watched):
    watched.period("insert", depth=GOAL)
    watched.period("insert", name=None, depth=0.0)
    watched.period("retreat", depth=0.0)
    assert watched.referee.seated


def test_a_run_within_the_bound_was_never_over(watched):
    for _ in range(5):
        watched.period(force=(1.5, -1.5))
    assert watched.referee.over() == 0


@pytest.mark.parametrize("force", [(1.51, 0.0), (-1.51, 0.0), (0.0, 1.51), (0.0, -1.51)])
def test_periods_over_the_bound_count_from_the_first(watched, force):
    watched.period()
    for _ in range(3):
        watched.period(force=force)
    assert watched.referee.over() == 3


def test_a_force_that_falls_below_the_bound_starts_the_count_anew(watched):
    for force in (2.0, 2.0, 0.0, 2.0):
        watched.period(force=(force, 0.0))
    assert watched.referee.over() == 1


def test_one_sample_over_the_bound_is_not_a_mean_over_it(watched):
    force = np.zeros((8, 2))
    force[3, 0] = 5.0
    watched.period(force=force)
    assert watched.referee.over() == 0
