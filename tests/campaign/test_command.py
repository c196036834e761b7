"""`hil campaign`, and what every experiment's options do to a campaign."""

import io
import json
import sys

import pytest
from rich.console import Console

from hil.campaign.campaign import Workers, carry_out
from hil.campaign.errors import CampaignError
from hil.campaign.ledger import opened
from hil.campaign.progress import CampaignProgress
from hil.campaign.run import Outcome, Run, Verdict
from hil.cli import campaign
from hil.cli.main import call


@pytest.fixture
def hil(capsys):
    def run(*arguments):
        status = call([str(argument) for argument in arguments])
        return status, *capsys.readouterr()

    return run


@pytest.fixture
def ledger(plan, tmp_path):
    """A ledger with runs of which seed 5 failed and seed 17 crashed."""
    path = tmp_path / "a.db"
    with opened(path) as kept:
        for seeds in (range(4, 7), range(17, 18)):
            carry_out(plan("mixed", seeds), kept, Workers(), "v1")
    return path


def test_show_counts_verdicts_and_names_what_did_not_pass(hil, ledger):
    status, out, _ = hil("campaign", "show", ledger)
    lines = out.splitlines()
    assert status == 0
    assert lines[0].startswith("4 runs: crash 1, failed 1, passed 2;")
    assert lines[1] == "4 by v1"
    assert "ended by SIGABRT" in out
    assert lines[-2].startswith(f"again: hil campaign rerun {ledger} ")


def test_the_command_that_show_prints_performs_that_run_again(hil, ledger):
    _, out, _ = hil("campaign", "show", ledger)
    command = out.splitlines()[-2].removeprefix("again: hil ").split()
    status, out, _ = hil(*command)
    assert status == 1
    assert out.splitlines()[0] in {"failed", "crash: ended by SIGABRT"}


def test_programs_get_the_same_as_json(hil, ledger):
    _, out, _ = hil("campaign", "show", ledger, "--json")
    found = json.loads(out)
    assert found["verdicts"] == {"crash": 1, "failed": 1, "passed": 2}
    assert {broken["seed"] for broken in found["broken"]} == {5, 17}


def test_a_ledger_or_a_run_there_is_not_is_one_line_and_status_2(hil, ledger, tmp_path):
    for command in (["show", tmp_path / "none.db"], ["rerun", ledger, "abc"]):
        status, out, err = hil("campaign", *command)
        assert (status, out, err.count("\n")) == (2, "", 1)
        assert err.startswith("hil: ")


def conducted(plan, ledger=None, **options):
    usual = {"jobs": 1, "scheduler": "", "fresh": False, "quiet": True}
    return campaign.conduct(plan, ledger=ledger, **{**usual, **options})


def test_fresh_computes_again_what_the_ledger_holds(plan, tmp_path, monkeypatch):
    monkeypatch.setattr("hil.campaign.code.identity", lambda: "v1")
    series, marks = plan("noted", range(3), marks=str(tmp_path / "marks")), tmp_path / "marks"
    for fresh, computed in [(False, 3), (False, 3), (True, 6)]:
        conducted(series, tmp_path / "a.db", fresh=fresh)
        assert len(marks.read_text(encoding="utf-8").splitlines()) == computed


def test_an_interrupted_campaign_says_how_to_go_on(plan, tmp_path, monkeypatch, capsys):
    def interrupt(self, run, outcome):
        self._verdicts[outcome.verdict] += 1
        raise KeyboardInterrupt

    monkeypatch.setattr(CampaignProgress, "update", interrupt)
    with pytest.raises(KeyboardInterrupt):
        conducted(plan("square", range(3)), tmp_path / "a.db")
    path = tmp_path / "a.db"
    expected = f"hil: 1 of 3 runs are in {path}; the same command goes on from there\n"
    assert capsys.readouterr().err == expected


def test_a_part_there_is_not_is_refused_before_any_run(hil):
    status, _, err = hil("experiment", "insertion", "--part", "FFC9")
    assert (status, err.count("\n")) == (2, 1)


@pytest.mark.parametrize("quiet", [True, False])
def test_progress_shows_what_broke_unless_quiet(quiet):
    screen = io.StringIO()
    console = Console(file=screen, force_terminal=True, width=100)
    with CampaignProgress(3, quiet=quiet, console=console) as progress:
        for verdict in (Verdict.PASSED, Verdict.CRASH):
            progress.update(Run("m:f", "", 1), Outcome(verdict))
    assert progress.done == 2
    assert ("crash 1, passed 1" in screen.getvalue()) is not quiet


def test_a_scheduler_needs_dask(plan, monkeypatch):
    monkeypatch.setitem(sys.modules, "hil.campaign.cluster", None)
    with pytest.raises(CampaignError, match="pip install"):
        conducted(plan("square"), scheduler="tcp://127.0.0.1:1")
