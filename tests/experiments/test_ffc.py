from math import isnan

import pytest

from controller.outcome import Kind
from hil.app.train import EpisodeResult, Schedule
from hil.campaign.run import Run
from hil.cell.rig import parse
from hil.cli.shipped import read
from hil.experiments.ffc.rows import quick_from, rows
from hil.experiments.ffc.runs import Training, box, one, plan
from hil.experiments.ffc.table import as_text
from learner.errors import UnknownLearnerError

TEXT = read("ffc_learning")[1].decode()


def result(number, steps, kind=Kind.INSERTED, part="FFC1"):
    return EpisodeResult(number, part, kind, "", steps, 1.0)


def test_a_training_drives_both_cables_and_repeats_to_the_step():
    variant = {"learner": "wdql", "parts": [["FFC1", 2], ["FFC2", 1]]}
    run = Run("hil.experiments.ffc.runs:one", TEXT, 1, variant)
    first, again = one(run), one(run)
    episodes = first.figures["episodes"]
    assert [episode["part"] for episode in episodes] == ["FFC1", "FFC1", "FFC2"]
    assert {episode["kind"] for episode in episodes} <= {"inserted", "danger", "limit"}
    assert episodes == again.figures["episodes"]


def test_the_box_of_the_learning_rig_has_847_poses():
    assert box(parse(TEXT)).states == 847


def test_a_learner_that_there_is_not_is_said_before_anything_runs():
    with pytest.raises(UnknownLearnerError, match="did you mean 'wdql'"):
        plan(TEXT, ("wdqll",), range(1, 3), Schedule())


def test_rates_are_shares_of_all_episodes_and_count_each_seed_once():
    kinds = [Kind.INSERTED, Kind.INSERTED, Kind.DANGER, Kind.LIMIT]
    training = Training("wdql", 1, tuple(result(i, 5, kind) for i, kind in enumerate(kinds, 1)))
    (row,) = rows([training, training])
    assert (row.seeds, row.success.value, row.danger.value, row.step_limit.value) == (
        2, 0.5, 0.25, 0.25,
    )  # fmt: skip
    assert (row.success.low, row.success.high) == (0.5, 0.5)


def test_steps_of_the_second_cable_are_those_of_its_first_episode():
    episodes = (
        result(1, 40),
        result(2, 30),
        result(3, 11, part="FFC2"),
        result(4, 99, part="FFC2"),
    )
    (row,) = rows([Training("belief", 1, episodes)])
    assert row.ffc2_first_steps_mean.value == 11
    assert row.training_steps.value == 70
    assert isnan(row.late_steps.value)


@pytest.mark.parametrize(
    ("steps", "begin"), [([5] * 5, 1), ([30] + [20] * 5, 2), ([5] * 4, 5), ([30] * 8, 9)]
)
def test_quick_is_five_in_a_row_within_twenty_steps(steps, begin):
    assert quick_from([result(i, n) for i, n in enumerate(steps, 1)]) == begin


def test_a_run_that_broke_is_named_and_counts_in_no_rate():
    good = Training("wdql", 1, tuple(result(i, 5) for i in range(1, 7)))
    (row,) = rows([good, Training("wdql", 2, (), "hang")])
    assert (row.seeds, row.broken, row.success.value) == (1, 1, 1.0)
    assert "1 (1 broken)" in as_text([row])
