"""Figures and page of `hil experiment ffc`, and the fast model's table."""

from controller.outcome import Kind
from hil.app.train import EpisodeResult
from hil.campaign.run import Outcome, Run, Verdict
from hil.cli.shipped import read
from hil.experiments.fast_model import CLASSES, as_text, confusion, one
from hil.experiments.ffc.report import write
from hil.experiments.ffc.runs import Training
from hil.experiments.ffc.sight import Sight

SIGHT = Sight(
    [(0.008 * i, 0.1, -0.1, 5.0, -1e-6 * i) for i in range(50)],
    [[float(x + y) for y in range(11)] for x in range(11)],
)


def training(learner, seed):
    kinds = [Kind.DANGER, Kind.LIMIT, *[Kind.INSERTED] * 6]
    episodes = tuple(
        EpisodeResult(i, "FFC1" if i < 8 else "FFC2", kind, "", 5 + seed, 3.0)
        for i, kind in enumerate(kinds, 1)
    )
    return Training(learner, seed, episodes, sight=SIGHT)


def test_the_page_has_every_figure_inside_and_names_what_the_paper_says(tmp_path):
    runs = [training(name, seed) for name in ("wdql", "belief") for seed in (1, 2)]
    page, *pictures = write(runs, "ffc_learning", tmp_path / "out")
    assert [path.name for path in pictures] == ["fig9.png", "fig10.png", "fig11.png", "fig12.png"]
    text = page.read_text()
    assert text.count("data:image/png;base64,") == 4
    assert "about 30 steps with FFC2" in text
    assert "75 % [75, 75]" in text


def test_a_learner_without_worth_or_insertion_leaves_its_figures_out(tmp_path):
    bare = Training("search", 1, training("search", 1).episodes, sight=Sight([], []))
    _, *pictures = write([bare], "ffc_learning", tmp_path / "out")
    assert [path.name for path in pictures] == ["fig9.png", "fig10.png"]


def test_confusion_counts_what_both_made_of_each_pose_and_no_broken_run():
    whole = Outcome(Verdict.PASSED, figures={"pairs": [["face", "face"], ["caught", "inserted"]]})
    found = confusion([whole, whole, Outcome(Verdict.HANG)])
    assert (found.trials, found.agreement) == (4, 0.5)
    assert found.counts["caught"]["inserted"] == 2
    assert "4 poses, the same outcome on 50.0 %" in as_text(found, {}, (1e-4, 2e-4))


def test_plant_and_world_are_led_by_the_same_steps_to_mostly_the_same_end():
    text = read("ffc_learning")[1].decode()
    report = one(Run("hil.experiments.fast_model:one", text, 1, {"steps": 2}))
    found = confusion([Outcome(Verdict.PASSED, figures=report.figures)])
    assert found.trials == 25
    assert found.agreement > 0.6
    assert {end for row in found.counts.values() for end in row} == set(CLASSES)
