"""A campaign survives its runs and its own death, and gives the same for any number of workers."""

import json
import os
import signal
import subprocess
import sys
from collections import Counter
from contextlib import contextmanager
from pathlib import Path

import pytest

from hil.campaign.campaign import Workers, again, carry_out
from hil.campaign.errors import CampaignError
from hil.campaign.ledger import opened, reading
from hil.campaign.plan import Plan, grid
from hil.campaign.run import Run, Verdict

SCRIPT = Path(__file__).with_name("campaign.py")
CODE = "tested"


@contextmanager
def started(ledger, function, seeds, jobs, **variant):
    """The campaign's process. Dask's threads outlive its cluster, so no test runs it here."""
    arguments = [str(ledger), f"behaviours:{function}", str(seeds), str(jobs), json.dumps(variant)]
    with subprocess.Popen(
        [sys.executable, str(SCRIPT), *arguments], stdout=subprocess.PIPE, text=True
    ) as process:
        yield process


def digest(*arguments, **variant):
    """What a campaign that runs to its end prints last."""
    with started(*arguments, **variant) as process:
        lines = process.stdout.read().splitlines()
    assert process.returncode == 0
    return lines[-1]


def test_two_crashes_and_a_hang_cost_no_other_run(tmp_path):
    digest(tmp_path / "a.db", "mixed", 100, 2)
    with reading(tmp_path / "a.db") as ledger:
        entries = list(ledger.entries())
    verdicts = Counter(entry.outcome.verdict for entry in entries)
    assert verdicts == {
        Verdict.PASSED: 96, Verdict.FAILED: 1, Verdict.CRASH: 2, Verdict.HANG: 1
    }  # fmt: skip
    broken = {entry.key.seed for entry in entries if not entry.outcome.figures}
    assert broken == {17, 42, 58}
    assert all(
        entry.outcome.figures == {"square": entry.key.seed**2}
        for entry in entries
        if entry.key.seed not in broken
    )


def test_a_ledger_does_not_show_how_many_workers_there_were(tmp_path):
    found = {digest(tmp_path / f"{jobs}.db", "mixed", 25, jobs) for jobs in (1, 2, 4)}
    assert len(found) == 1


def test_a_campaign_killed_in_the_middle_goes_on_where_it_was(tmp_path):
    marks = tmp_path / "marks"
    with started(tmp_path / "a.db", "noted", 200, 2, marks=str(marks)) as process:
        for _ in range(40):
            process.stdout.readline()
        os.kill(process.pid, signal.SIGKILL)
    with reading(tmp_path / "a.db") as ledger:
        kept = {entry.key.seed for entry in ledger.entries()}
    assert 40 <= len(kept) < 200
    resumed = digest(tmp_path / "a.db", "noted", 200, 2, marks=str(marks))
    computed = Counter(int(line) for line in marks.read_text(encoding="utf-8").splitlines())
    assert {computed[seed] for seed in kept} == {1}
    assert resumed == digest(tmp_path / "b.db", "noted", 200, 1, marks=str(marks))


def test_what_a_ledger_holds_is_not_computed_again(plan, tmp_path):
    series = plan("noted", range(5), marks=str(tmp_path / "marks"))
    with opened(None) as ledger:
        first = carry_out(series, ledger, Workers(), CODE)
        seen = []
        second = carry_out(series, ledger, Workers(), CODE, lambda run, _: seen.append(run.seed))
    assert first == second
    assert seen == [0, 1, 2, 3, 4]
    assert len((tmp_path / "marks").read_text(encoding="utf-8").splitlines()) == 5


def test_other_code_computes_for_itself(plan, tmp_path):
    series = plan("noted", range(2), marks=str(tmp_path / "marks"))
    with opened(None) as ledger:
        for code in ("one", "other"):
            carry_out(series, ledger, Workers(), code)
        assert [entry.code for entry in ledger.entries()] == ["one", "other"] * 2


def test_outcomes_come_in_the_plans_order(outcomes):
    series = grid("behaviours:square", "", range(3), limit=60.0, variants=[{"offset": 2}, {}])
    found = [tuple(outcome.figures.values()) for outcome in outcomes(series)]
    assert found == [(2, 0), (2, 1), (2, 4), (0, 0), (0, 1), (0, 4)]


def test_a_run_of_a_ledger_can_be_performed_by_itself():
    assert again(Run("behaviours:square", "", 7), 60.0).figures["square"] == 49


def test_a_run_may_not_be_in_a_plan_twice():
    with pytest.raises(CampaignError, match="the same"):
        Plan("behaviours:square", (Run("behaviours:square", "", 1),) * 2, 1.0)


@pytest.mark.parametrize("limit", [0.0, -1.0, float("nan")])
def test_a_limit_must_be_above_zero(limit):
    with pytest.raises(CampaignError, match="above 0"):
        grid("behaviours:square", "", range(1), limit=limit)
