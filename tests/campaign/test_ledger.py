"""The ledger keeps every run by everything its figures depend on."""

import sqlite3

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.campaign.errors import CampaignError
from hil.campaign.ledger import opened, reading
from hil.campaign.run import Outcome, Run, Verdict, decode_outcome, decode_run, encode

RUN = Run("m:f", "name: a", 1, {"law": "soft"})
OTHERS = [
    Run("m:g", "name: a", 1, {"law": "soft"}),
    Run("m:f", "name: b", 1, {"law": "soft"}),
    Run("m:f", "name: a", 2, {"law": "soft"}),
    Run("m:f", "name: a", 1, {"law": "constant"}),
]
PASSED = Outcome(Verdict.PASSED, figures={"rms": 0.125})

numbers = st.floats(allow_nan=False, allow_infinity=False)
values = st.recursive(
    st.none() | st.booleans() | st.integers() | numbers | st.text(), st.lists, max_leaves=5
)
variants = st.dictionaries(st.text(), values, max_size=4)
runs = st.builds(Run, st.text(), st.text(), st.integers(0, 2**62), variants)
outcomes = st.builds(
    Outcome,
    st.sampled_from(Verdict),
    st.text(),
    variants,
    st.dictionaries(st.text(), numbers),
    st.text(),
    numbers,
)


@given(runs, outcomes)
def test_a_run_and_its_outcome_survive_a_pipe_and_a_ledger(run, outcome):
    assert decode_run(encode(run)) == run
    assert decode_outcome(encode(outcome)) == outcome
    with opened(None) as ledger:
        ledger.put(run, "c", outcome)
        assert ledger.find(run, "c") == outcome
        assert ledger.named(run.key.name) == run


@given(st.permutations([RUN, *OTHERS]))
def test_the_digest_does_not_depend_on_who_was_first(order):
    def digest(runs, wall):
        with opened(None) as ledger:
            for run in runs:
                figures = {"seed": run.seed}
                ledger.put(run, "c", Outcome(Verdict.PASSED, figures=figures, wall=wall))
            return ledger.digest()

    assert digest(order, 0.1) == digest([RUN, *OTHERS], 0.2)


@pytest.mark.parametrize("other", OTHERS)
def test_runs_that_differ_in_anything_are_kept_apart(other):
    with opened(None) as ledger:
        ledger.put(RUN, "c", PASSED)
        assert ledger.find(other, "c") is None
        assert ledger.find(RUN, "d") is None
        assert ledger.find(RUN, "c") == PASSED


@pytest.mark.parametrize(
    "changed", [Outcome(Verdict.FAILED, figures={"rms": 0.125}), Outcome(Verdict.PASSED, "", {})]
)
def test_the_digest_covers_verdict_and_figures(changed):
    def digest(outcome):
        with opened(None) as ledger:
            ledger.put(RUN, "c", outcome)
            return ledger.digest()

    assert digest(changed) != digest(PASSED)


def test_what_is_forgotten_is_computed_again_and_nothing_else():
    with opened(None) as ledger:
        for run in (RUN, *OTHERS):
            ledger.put(run, "c", PASSED)
        ledger.forget([RUN], "c")
        assert ledger.find(RUN, "c") is None
        assert len(list(ledger.entries())) == len(OTHERS)


def test_a_ledger_is_there_when_opened_again(tmp_path):
    path = tmp_path / "new" / "a.db"
    with opened(path) as ledger:
        ledger.put(RUN, "c", PASSED)
    with reading(path) as ledger:
        assert ledger.find(RUN, "c") == PASSED


def test_a_ledger_can_be_read_while_a_campaign_writes_it(tmp_path):
    with opened(tmp_path / "a.db") as ledger:
        ledger.put(RUN, "c", PASSED)
        with reading(tmp_path / "a.db") as seen:
            assert seen.digest() == ledger.digest()


def test_two_campaigns_never_write_one_ledger(tmp_path):
    with (
        opened(tmp_path / "a.db"),
        pytest.raises(CampaignError, match="another campaign writes it"),
        opened(tmp_path / "a.db"),
    ):
        pass


def test_no_file_a_text_and_a_foreign_database_are_no_ledgers(tmp_path):
    (tmp_path / "text").write_text("name: no ledger, and long enough to tell" * 30)
    foreign = sqlite3.connect(tmp_path / "foreign")
    foreign.execute("CREATE TABLE films (title TEXT)")
    foreign.close()
    for name, words in [("none", "no ledger"), ("text", "cannot be used"), ("foreign", "no camp")]:
        with pytest.raises(CampaignError, match=words), reading(tmp_path / name):
            pass
    with pytest.raises(CampaignError, match="no campaign's ledger"), opened(tmp_path / "foreign"):
        pass
    with pytest.raises(CampaignError, match="cannot"), opened(tmp_path / "text" / "a.db"):
        pass


def test_a_name_that_no_run_has_is_refused():
    with opened(None) as ledger, pytest.raises(CampaignError, match="no run 'abc'"):
        ledger.named("abc")
