import numpy as np
import pytest

from controller.action import Observation
from learner.belief.sides import Sides, likelihood
from learner.grid import Cell

SHAPE = (9, 9, 9)
AT = Cell(4, 4, 4)


def seen(fx=1.0, fy=1.0, tau=1.0):
    return Observation(fx, fy, 5.0, tau, 0.0, 0.0, 0.0, 0.0)


def test_a_slot_on_the_side_of_the_force_is_likelier():
    told = likelihood(SHAPE, AT, seen(fx=2.0), Sides((0.75, 0.5, 0.5)))
    assert told[6, 4, 4] == pytest.approx(1.5)
    assert told[2, 4, 4] == pytest.approx(0.5)


def test_a_sign_that_is_a_coin_says_nothing():
    told = likelihood(SHAPE, AT, seen(-1.0, 2.0, -3.0), Sides((0.5, 0.5, 0.5)))
    assert np.all(told == 1.0)


def test_beyond_its_reach_along_any_axis_a_force_says_nothing():
    told = likelihood(SHAPE, AT, seen(), Sides((0.9, 0.9, 0.9), reach=2))
    assert told[8, 5, 5] == told[5, 8, 5] == told[5, 5, 8] == 1.0
    assert told[5, 5, 5] > 1.0


def test_no_force_says_nothing():
    told = likelihood(SHAPE, AT, seen(0.0, 0.0, 0.0), Sides((0.9, 0.9, 0.9)))
    assert np.all(told == 1.0)


def test_chances_that_are_none_are_refused():
    with pytest.raises(ValueError, match="between 0 and 1"):
        Sides((1.0, 0.5, 0.5))
