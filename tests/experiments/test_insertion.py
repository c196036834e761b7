"""The insertion experiment as a campaign's function."""

import pytest

from hil.campaign.campaign import Workers, carry_out
from hil.campaign.ledger import opened
from hil.campaign.run import Outcome, Verdict
from hil.cell.errors import RigError
from hil.cli.shipped import read
from hil.experiments.insertion import one, plan, rows


@pytest.fixture
def rig():
    _, content = read("ffc_ur5")
    return content.decode()


def test_a_worker_finds_what_this_process_finds(rig):
    series = plan(rig, "FFC1", "oracle", range(7, 8))
    with opened(None) as ledger:
        (outcome,) = carry_out(series, ledger, Workers(), "tested")
    here = one(series.runs[0])
    assert outcome.figures == here.figures
    assert outcome.verdict is here.verdict is Verdict.PASSED


def test_a_run_that_broke_is_a_row_and_no_success(rig):
    series = plan(rig, "FFC1", "pose", range(1, 2))
    (row,) = rows(series, [Outcome(Verdict.CRASH, "ended by SIGSEGV")])
    assert (row.kind, row.reason, row.seated) == ("crash", "ended by SIGSEGV", False)


def test_a_part_there_is_not_is_refused_before_any_run(rig):
    with pytest.raises(RigError, match="FFC9"):
        plan(rig, "FFC9", "pose", range(1, 2))
