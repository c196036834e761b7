"""What a run does to itself is its own verdict, and nobody else's."""

import os
import select
from pathlib import Path

import pytest

from hil.campaign.errors import CampaignError
from hil.campaign.plan import grid
from hil.campaign.run import Run, Verdict
from hil.campaign.slot import Slot, Work


def ended(pid, seconds=10):
    """Whether a process is gone, or goes within so many wall seconds."""
    try:
        handle = os.pidfd_open(pid)
    except ProcessLookupError:
        return True
    try:
        return bool(select.select([handle], [], [], seconds)[0])
    finally:
        os.close(handle)


def test_figures_come_back_as_they_were_returned(outcome):
    found = outcome("square", seeds=range(3, 4), offset=2)
    assert found.verdict is Verdict.PASSED
    assert found.figures == {"square": 9, "offset": 2}


def test_an_exception_is_an_error_with_its_words_and_place(outcome):
    found = outcome("raising")
    assert (found.verdict, found.reason) == (Verdict.ERROR, "RuntimeError: no such thing as 0")
    assert "in raising" in found.trace


def test_sys_exit_is_an_error(outcome):
    assert outcome("leaving").reason == "SystemExit: 3"


def test_a_process_that_ends_by_itself_is_a_crash(outcome):
    found = outcome("quitting")
    assert (found.verdict, found.reason) == (Verdict.CRASH, "ended by exit status 3")


@pytest.mark.parametrize(("seed", "signal"), [(17, "SIGABRT"), (58, "SIGSEGV")])
def test_a_crash_is_named_by_its_signal_and_its_line(outcome, seed, signal):
    found = outcome("mixed", seeds=range(seed, seed + 1))
    assert (found.verdict, found.reason) == (Verdict.CRASH, f"ended by {signal}")
    assert "in mixed" in found.trace


def test_a_hang_ends_at_its_limit_and_says_where_it_hung(outcome):
    found = outcome("mixed", seeds=range(42, 43), limit=0.5)
    assert (found.verdict, found.reason) == (Verdict.HANG, "no result within 0.5 s")
    assert "in mixed" in found.trace


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("infinite", "ValueError: Out of range float"),
        ("careless", "TypeError: behaviours:careless"),
    ],
)
def test_figures_that_no_ledger_can_hold_are_an_error(outcome, name, words):
    found = outcome(name)
    assert found.verdict is Verdict.ERROR
    assert found.reason.startswith(words)


def test_figures_may_be_larger_than_a_pipe(outcome):
    assert len(outcome("large").figures["text"]) == 3_000_000


def test_what_a_run_prints_goes_nowhere(outcome, capfd):
    assert outcome("talking").figures == {"threads": "1"}
    assert capfd.readouterr() == ("", "")


def test_imports_are_shared_and_prepared_once(plan, outcomes):
    first, second = outcomes(plan("worker", range(2)))
    assert first.figures == second.figures
    (found,) = outcomes(plan("prepared", prepare="behaviours:prepare"))
    assert found.figures == {"prepared": "name: bench"}


def test_processes_a_run_leaves_behind_end_with_it(outcome, tmp_path):
    path = tmp_path / "pid"
    assert outcome("forking", pid=str(path)).verdict is Verdict.PASSED
    assert ended(int(path.read_text(encoding="utf-8")))


def test_a_run_ends_when_its_worker_is_closed(tmp_path):
    path = tmp_path / "pid"
    with Slot(Work("behaviours:sleeping", 60.0)) as slot:
        slot.submit(Run("behaviours:sleeping", "", 0, {"pid": str(path)}))
        pid = _appeared(path, slot)
    assert ended(pid)


def _appeared(path: Path, slot: Slot) -> int:
    """The number in a file that a run writes; fails if the run ends without it."""
    while not path.exists():
        assert not select.select([slot], [], [], 0.01)[0], slot.outcome()
    return int(path.read_text(encoding="utf-8"))


def test_a_worker_that_cannot_start_is_no_runs_crash(monkeypatch):
    monkeypatch.setattr("sys.executable", "/bin/false")
    with (
        Slot(Work("behaviours:square", 1.0)) as slot,
        pytest.raises(CampaignError, match="could not be started"),
    ):
        slot.submit(Run("behaviours:square", "", 0))


@pytest.mark.parametrize(
    ("function", "words"),
    [
        ("behaviours", "write module:function"),
        ("behaviour:square", "there is no module 'behaviour'"),
        ("behaviours:sqare", "has no function 'sqare'; did you mean 'square'"),
    ],
)
def test_a_function_there_is_not_is_refused_before_any_run(function, words):
    with pytest.raises(CampaignError, match=words):
        grid(function, "", range(3), limit=1.0)
