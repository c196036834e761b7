import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.outcome import Kind
from learner.task import reward


@given(st.integers(0, 500))
def test_success_pays_more_the_sooner_it_comes(step):
    assert reward(Kind.INSERTED, step, 500) == pytest.approx(1 - step / 500)
    assert reward(Kind.INSERTED, step, 500) >= 0 > reward(Kind.LIMIT, 500, 500)


@given(st.integers(0, 500))
def test_danger_costs_most_whenever_it_comes(step):
    assert reward(Kind.DANGER, step, 500) == -1.0 < reward(Kind.LIMIT, step, 500) == -0.5


@pytest.mark.parametrize("kind", [Kind.NO_GRIP, Kind.FAULT, Kind.DONE])
def test_what_was_no_episode_has_no_reward(kind):
    with pytest.raises(ValueError, match="no reward"):
        reward(kind, 0, 500)
