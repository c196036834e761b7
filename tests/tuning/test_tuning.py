"""Study files, constraints, and a search that is stopped and goes on."""

import pytest
import yaml
from optuna.trial import create_trial

from hil.experiments.force_tracking.presets import preset
from hil.tuning.errors import TuningError
from hil.tuning.objective import UNSTABLE, purpose, worth
from hil.tuning.preset_file import write
from hil.tuning.search import best, search
from hil.tuning.study_file import StudyFile, load, nested
from hil_fixtures.testbed import shipped


@pytest.fixture
def rig():
    return shipped("surface_ur5")


@pytest.fixture
def study():
    return StudyFile(
        law="constant", stiffnesses=(3.0,), objective={"settling": 1.0},
        parameters={"damping": {"low": 100.0, "high": 5000.0, "log": True, "start": 4000.0}},
    )  # fmt: skip


def ignore(_):
    pass


def test_a_search_improves_on_its_start(study, rig, tmp_path):
    found = search(purpose(study, rig), tmp_path / "j", trials=8, seed=1, tell=ignore)
    assert found.value < worth(study, rig, {"damping": 4000.0}).cost


def test_a_resumed_search_computes_only_what_is_left(study, rig, tmp_path):
    told = []
    search(purpose(study, rig), tmp_path / "j", trials=3, seed=1, tell=told.append)
    search(purpose(study, rig), tmp_path / "j", trials=4, seed=1, tell=told.append)
    assert [trial.number for trial in told] == [0, 1, 2, 3]


def test_a_journal_of_another_study_is_refused(study, rig, tmp_path):
    search(purpose(study, rig), tmp_path / "j", trials=1, seed=1, tell=ignore)
    other = study.model_copy(update={"force": 5.0})
    with pytest.raises(TuningError, match="another study"):
        search(purpose(other, rig), tmp_path / "j", trials=2, seed=1, tell=ignore)


def test_an_unstable_set_costs_more_than_a_stable_one_and_breaks_the_constraint(study, rig):
    stable, wild = (worth(study, rig, {"damping": b}) for b in (1180.0, 20.0))
    assert wild.cost == UNSTABLE > stable.cost
    assert wild.violations == {"unstable": 1.0}
    assert stable.violations == {"unstable": 0.0}


def trial(value, violation):
    made = create_trial(value=value)
    made.set_constraint("unstable", violation)
    return made


def test_the_best_trial_keeps_the_constraints_before_it_is_cheap():
    cheap, sound = trial(-5.0, 2.0), trial(1.0, -0.1)
    assert best([cheap, sound]) is sound
    assert best([cheap, trial(-9.0, 3.0)]) is cheap


def test_a_preset_names_the_command_that_made_it_and_keeps_other_laws(study, tmp_path):
    path = tmp_path / "p.yaml"
    path.write_text("# soft: by hand\nsoft: {bandwidth: 0.5}\n")
    made = trial(1.0, 0.0)
    fixed = study.model_copy(update={"fixed": {"damping": 900.0}})
    write(path, fixed, made, "hil tune force mine.yaml")
    assert "# constant: hil tune force mine.yaml" in path.read_text()
    assert preset(str(path)) == {"soft": {"bandwidth": 0.5}, "constant": {"damping": 900.0}}


def test_dotted_names_are_groups():
    assert nested({"a.b": 1.0, "a.c": 2.0, "d": 3.0}) == {"a": {"b": 1.0, "c": 2.0}, "d": 3.0}
    with pytest.raises(TuningError, match="a number and a group"):
        nested({"a": 1.0, "a.b": 2.0})


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"objective": {"speed": 1.0}}, "objective"),
        ({"parameters": {}}, "parameters"),
        ({"parameters": {"damping": {"low": 2.0, "high": 1.0}}}, "below high"),
        ({"parameters": {"damping": {"low": 0.0, "high": 1.0, "log": True}}}, "above 0"),
        ({"trials": 3}, "trials"),
    ],
)
def test_a_wrong_study_file_is_one_line(tmp_path, change, said):
    content = {"law": "constant", "objective": {"settling": 1.0},
               "parameters": {"damping": {"low": 1.0, "high": 2.0}}}  # fmt: skip
    path = tmp_path / "s.yaml"
    path.write_text(yaml.safe_dump({**content, **change}))
    with pytest.raises(TuningError, match=said) as caught:
        load(path)
    assert "\n" not in str(caught.value)


def test_a_parameter_that_the_law_has_not_is_named(study, rig):
    with pytest.raises(TuningError, match="did you mean 'damping'"):
        worth(study, rig, {"dampng": 1.0})


def test_a_missing_study_file_is_one_line(tmp_path):
    with pytest.raises(TuningError, match="cannot be read"):
        load(tmp_path / "none.yaml")
