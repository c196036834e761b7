import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from learner.belief import filter as bayes
from learner.grid import Cell

SHAPE = (5, 4, 3)
KERNEL = np.array([0.95, 0.3])
CELLS = st.builds(Cell, *(st.integers(0, size - 1) for size in SHAPE))


@st.composite
def beliefs(draw):
    weights = draw(arrays(float, SHAPE, elements=st.floats(1e-6, 1.0)))
    return weights / weights.sum()


def entropy(belief):
    return -(belief * np.log(belief)).sum()


def is_belief(belief):
    return belief.sum() == pytest.approx(1.0) and belief.min() > 0.0


@given(beliefs(), st.lists(st.tuples(CELLS, st.booleans()), max_size=30))
def test_whatever_happens_the_belief_sums_to_one_and_rules_no_pose_out(belief, events):
    for at, went_in in events:
        chance = bayes.going_in(SHAPE, at, KERNEL)
        belief = bayes.inserted(belief, chance) if went_in else bayes.missed(belief, chance)
        assert is_belief(belief)


@given(beliefs(), CELLS)
def test_a_miss_makes_the_slot_less_likely_here_and_an_insertion_more(belief, at):
    chance = bayes.going_in(SHAPE, at, KERNEL)
    assert bayes.missed(belief, chance)[at] < belief[at]
    assert bayes.inserted(belief, chance)[at] >= belief[at]


@given(beliefs(), CELLS)
def test_an_insertion_and_a_miss_weigh_the_belief_as_bayes_says(belief, at):
    chance = bayes.going_in(SHAPE, at, KERNEL)
    going = (belief * chance).sum()
    total = going * bayes.inserted(belief, chance) + (1 - going) * bayes.missed(belief, chance)
    assert total == pytest.approx(belief, abs=1e-9)


@given(beliefs())
def test_chance_of_success_is_the_mean_over_the_belief(belief):
    success = bayes.success(belief, KERNEL)
    for at in (Cell(0, 0, 0), Cell(2, 1, 1), Cell(4, 3, 2)):
        assert success[at] == pytest.approx((belief * bayes.going_in(SHAPE, at, KERNEL)).sum())


@given(beliefs(), st.tuples(*[st.integers(0, 4)] * 3))
def test_a_new_grip_never_makes_the_belief_surer(belief, clearance):
    widened = bayes.widened(belief, clearance, floor=0.02)
    assert entropy(widened) >= entropy(belief) - 1e-9
    assert is_belief(widened)


@given(beliefs(), st.floats(0.0, 0.5))
def test_drift_never_makes_the_belief_surer(belief, drift):
    drifted = bayes.drifted(belief, drift, floor=1e-4)
    assert entropy(drifted) >= entropy(belief) - 1e-9
    assert is_belief(drifted)
