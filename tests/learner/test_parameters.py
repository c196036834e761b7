import pytest

from learner.build import learners, maker, tunable
from learner.errors import LearnerParameterError, MissingExtraError, UnknownLearnerError
from learner.neural.build import check_extra
from learner.parallel.wdql import Parallel
from learner.parameters import parameters, with_parameters
from learner.tabular.settings import Rule, Tabular


@pytest.mark.parametrize("name", list(learners()))
def test_every_learner_takes_its_own_parameters_back(name):
    settings = learners()[name].settings
    assert with_parameters(settings, parameters(settings)) == settings


def test_a_dotted_name_reaches_into_a_part():
    changed = with_parameters(Parallel(), {"tabular.psi": 0.5, "tabular.rule": "double"})
    assert changed == Parallel(Tabular(Rule.DOUBLE, psi=0.5))


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"tabular.psy": 0.1}, "did you mean 'tabular.psi'"),
        ({"tabular": 1}, "no parameter 'tabular'"),
        ({"agents.x": 1}, "no parameter 'agents.x'"),
        ({"agents": 1.5}, "a number like 6"),
        ({"tabular.psi": 2.0}, "psi must be in"),
        ({"tabular.psi": True}, "a number like 0.01"),
        ({"tabular.rule": "triple"}, "single, double, weighted"),
        ({"tabular.random_ties": 1}, "true or false"),
    ],
)
def test_a_wrong_name_or_value_is_one_line(values, said):
    with pytest.raises(LearnerParameterError, match=said) as caught:
        maker("wdql", values)
    assert str(caught.value).startswith("learner wdql:")


def test_ones_own_learner_gets_parameters_by_keyword():
    import numpy as np  # noqa: PLC0415

    from learner.grid import Grid  # noqa: PLC0415

    make = maker(f"{__name__}:Own", {"boldness": 0.7})
    grid = Grid((1, 1, 1), (1.0, 1.0, 1.0))
    assert make(grid, 500, np.random.default_rng(1)).boldness == 0.7
    assert tunable(f"{__name__}:Own") == {}


class Own:
    def __init__(self, grid, max_steps, rng, boldness=0.5):
        self.boldness = boldness


def test_an_unknown_learner_is_told_the_nearest_name():
    with pytest.raises(UnknownLearnerError, match="did you mean 'ppo'"):
        maker("pppo")


def test_a_missing_extra_is_said_with_what_to_do():
    with pytest.raises(MissingExtraError, match=r"needs no_such_package: run `make baselines`"):
        check_extra("dql", ("no_such_package",))
