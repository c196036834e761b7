"""Tuning a learner: several seeds a set, whichever process computes them; stopped, it goes on."""

import pytest

from hil.experiments.peg_in_hole.contender import tuned
from hil.experiments.peg_in_hole.parameter_file import load, write
from hil.tuning.errors import TuningError
from hil.tuning.learner_study import LearnerStudy, cost, opened, purpose, worth
from hil.tuning.learner_study import Trial as Training
from hil.tuning.search import search
from hil.tuning.study_file import read
from learner.errors import LearnerParameterError, UnknownLearnerError, UnknownWorldError

STUDY = LearnerStudy(
    learner="search", worlds=("K3",), seeds=(1000, 1001), training=3, verification=1,
    parameters={"way": {"low": 0.0, "high": 2.0, "start": 0.6}, "turn": {"low": 1.0, "high": 3.0}},
)  # fmt: skip


def ignore(_):
    pass


def test_a_set_is_worth_the_mean_over_its_seeds():
    values = {"way": 0.6, "turn": 2.0}
    each = [cost(Training(STUDY, values, "K3", seed)) for seed in STUDY.seeds]
    assert worth(STUDY, values).cost == sum(each) / 2
    assert each[0] != each[1]


def test_how_many_processes_compute_does_not_change_the_trials(tmp_path):
    found = []
    for jobs in (1, 2):
        told = []
        with opened(jobs) as mapped:
            search(purpose(STUDY, mapped), tmp_path / str(jobs), trials=3, seed=1, tell=told.append)
        found.append([(trial.params, trial.value) for trial in told])
    assert found[0] == found[1]


def test_a_stopped_search_goes_on_from_its_journal(tmp_path):
    told = []
    for trials in (2, 4):
        search(purpose(STUDY), tmp_path / "j", trials=trials, seed=1, tell=told.append)
    assert [trial.number for trial in told] == [0, 1, 2, 3]
    other = STUDY.model_copy(update={"danger": 1.0})
    with pytest.raises(TuningError, match="another study"):
        search(purpose(other), tmp_path / "j", trials=5, seed=1, tell=ignore)


def test_the_search_begins_at_the_starts_and_takes_whole_numbers_and_choices(tmp_path):
    study = LearnerStudy(
        learner="wdql", worlds=("K3",), seeds=(1000,), training=1, verification=0,
        parameters={
            "rounds": {"low": 1, "high": 4, "whole": True, "start": 2},
            "tabular.rule": {"choices": ["weighted", "double"], "start": "double"},
        },
    )  # fmt: skip
    told = []
    search(purpose(study), tmp_path / "j", trials=2, seed=1, tell=told.append)
    assert told[0].params == {"rounds": 2, "tabular.rule": "double"}
    assert isinstance(told[1].params["rounds"], int)


@pytest.mark.parametrize(
    ("change", "error", "said"),
    [
        ({"worlds": ("K9",)}, UnknownWorldError, "no world 'K9'"),
        ({"learner": "serch"}, UnknownLearnerError, "did you mean 'search'"),
        ({"parameters": {"wya": {"low": 0.0, "high": 1.0}}}, LearnerParameterError, "mean 'way'"),
        ({"parameters": {"way": {"low": -1.0, "high": 1.0}}}, LearnerParameterError, "negative"),
    ],
)
def test_what_the_learner_refuses_is_said_before_the_first_trial(change, error, said):
    study = LearnerStudy.model_validate({**STUDY.model_dump(), **change})
    with pytest.raises(error, match=said):
        purpose(study)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("learner: ql\nparameters: {}", "parameters"),
        ("learner: ql\nparameters: {psi: {low: 1, high: 2, whole: true, start: 1.5}}", "whole"),
        ("learner: ql\nparameters: {rule: {choices: [a, b], start: c}}", "none of the choices"),
        ("learner: ql\ntrial: 3\nparameters: {psi: {low: 1, high: 2}}", "trial"),
    ],
)
def test_a_wrong_study_file_is_one_line(tmp_path, text, said):
    path = tmp_path / "s.yaml"
    path.write_text(text)
    with pytest.raises(TuningError, match=said) as caught:
        read(path, LearnerStudy)
    assert "\n" not in str(caught.value)


def test_the_best_set_is_a_file_that_the_experiment_takes(tmp_path):
    path = tmp_path / "t.yaml"
    write(path, "wdql", {"tabular.psi": 0.123456, "rounds": 7}, "hil tune learner wdql")
    (contender,) = tuned(load(path))
    assert dict(contender.changes) == {"tabular.psi": 0.1235, "rounds": 7}
    assert contender.label == "wdql tuned"


@pytest.mark.parametrize("text", ["- wdql", "wdql: 3", "wdql: {rounds: [1]}", "a: {b"])
def test_a_wrong_parameter_file_is_one_line(tmp_path, text):
    path = tmp_path / "t.yaml"
    path.write_text(text)
    with pytest.raises(LearnerParameterError) as caught:
        load(path)
    assert "\n" not in str(caught.value)
