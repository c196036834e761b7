import json

import pytest

from controller.outcome import Kind
from hil.app.train import EpisodeResult
from hil.campaign.run import Outcome, Verdict
from hil.experiments.ffc.runs import Training
from hil.experiments.peg_in_hole import runs
from hil.experiments.peg_in_hole.comparison import comparisons
from hil.experiments.peg_in_hole.contender import Contender, ablation, contenders
from hil.experiments.peg_in_hole.report import write
from learner.errors import UnknownLearnerError, UnknownWorldError
from learner.worlds.evaluate import Protocol


def done(world, field, seeds=range(1, 3), protocol=None):
    series = runs.plan(world, field, seeds, protocol or Protocol(2, 1))
    reports = [runs.one(run) for run in series.runs]
    outcomes = [Outcome(Verdict.PASSED, figures=report.figures) for report in reports]
    return runs.trainings(series, outcomes)


def test_every_contender_meets_the_same_cell_and_repeats():
    field = contenders(("search", "wdql"), (1, 2))
    found = done("K3", field)
    assert [t.learner for t in found] == ["search"] * 2 + ["wdql n=1"] * 2 + ["wdql n=2"] * 2
    assert [[e.part for e in t.episodes] for t in found] == [["FFC1", "FFC1", "FFC2"]] * 6
    assert found == done("K3", field)


def test_an_ablation_changes_one_thing_a_row_and_survives_json():
    field = ablation()
    assert len({contender.label for contender in field}) == len(field)
    assert all(len(contender.changes) <= 1 for contender in field)
    series = runs.plan("K3", field, range(1), Protocol(1, 0))
    again = json.loads(json.dumps([run.variant for run in series.runs]))
    for run, variant, contender in zip(series.runs, again, field, strict=True):
        assert runs._contender(run) == contender
        assert variant["learner"] == contender.learner


def test_names_that_there_are_not_are_said_before_anything_runs():
    with pytest.raises(UnknownLearnerError, match="in this experiment also shared-ql"):
        contenders(("wqdl",), (1,))
    with pytest.raises(UnknownWorldError, match="there are G0"):
        runs.plan("G1", (Contender("ql"),), range(1), Protocol())


def training(name, seed, steps):
    episodes = [EpisodeResult(i, "FFC1", Kind.INSERTED, "", n, 0.0) for i, n in enumerate(steps, 1)]
    return Training(name, seed, tuple(episodes))


def test_fewer_steps_in_every_pair_of_runs_is_a_probability_of_one():
    found = [training("wdql n=6", s, [30 + s, 30]) for s in range(3)]
    found += [training("belief", s, [10 + s, 10]) for s in range(3)]
    (one,) = comparisons(found, "wdql n=6")
    assert (one.learner, one.training_steps.value, one.success.value) == ("belief", 1.0, 0.5)


def test_the_report_sets_what_was_run_beside_the_papers_sentences(tmp_path):
    found = [training(f"wdql n={n}", s, [40] * 40) for n in (1, 6) for s in (1, 2)]
    found += [training("ql", s, [400] * 40) for s in (1, 2)]
    page = write(found, comparisons(found, "wdql n=6"), "G0", tmp_path / "out").read_text()
    assert "wdql n=1: 40 [40, 40]; wdql n=6: 40 [40, 40]" in page
    assert "ql: 400 [400, 400]" in page
    assert "Probability that a run is better than one of wdql n=6" in page
    assert (tmp_path / "out" / "fig4.png").read_bytes().startswith(b"\x89PNG")
